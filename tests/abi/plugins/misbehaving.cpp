// Effects that pass the loader's check and misbehave when they run: one library per case, named by TEST_CASE.
#include <stdexcept>
#include <string_view>

#include <brume/brume_plugin.h>

namespace {

constexpr std::string_view test_case = TEST_CASE;
constexpr brume_status nonsense = -123456789;

brume_status throwing_rows(const brume_plugin_rows *, int32_t, int32_t)
{
    throw std::runtime_error("thrown in rows");
}

brume_pass pass = nullptr;

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *, void **state)
{
    static int something;
    *state = &something;
    if (test_case == "throws_in_plan")
        throw std::runtime_error("thrown in plan");
    if (test_case == "nonsense_status_in_plan")
        return nonsense;
    if (test_case == "plan_without_entry")
        return BRUME_OK;
    const brume_plugin_entry entry{sizeof(brume_plugin_entry), 1, "pass", "always", 0, 0, 0, 0};
    if (brume_status status = services->add_entry(host, &entry); status || test_case != "throws_in_rows")
        return status;
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "pass";
    desc.rows = throwing_rows;
    desc.grain = 1;
    return services->create_pass(host, &desc, &pass);
}

brume_status execute(const brume_services *services, brume_host host, void *, const brume_plugin_frame *)
{
    if (test_case == "throws_in_execute")
        throw std::runtime_error("thrown in execute");
    if (test_case == "throws_int_in_execute")
        throw 42;
    if (test_case == "throws_in_rows")
        return services->run(host, pass, nullptr, nullptr, 1, 64, nullptr);
    if (test_case == "nonsense_status")
        return nonsense;
    if (test_case == "fails_without_message")
        return BRUME_ERROR_UNSUPPORTED;
    return BRUME_OK;
}

void destroy(void *)
{
    if (test_case == "throws_in_destroy")
        throw std::runtime_error("thrown in destroy");
    if (test_case == "throws_int_in_destroy")
        throw 42;
}

const brume_effect effect{
    .struct_size = sizeof(brume_effect),
    .abi = BRUME_PLUGIN_ABI,
    .name = TEST_CASE,
    .help = "Misbehaves",
    .order = 200,
    .thread_safety = BRUME_THREADS_SAFE,
    .wanted = BRUME_WANTED_NEVER,
    .parameter_count = 0,
    .layer_count = 0,
    .make_count = 0,
    .use_count = 0,
    .reserved = 0,
    .parameters = nullptr,
    .layers = nullptr,
    .makes = nullptr,
    .uses = nullptr,
    .plan = plan,
    .execute = execute,
    .destroy = destroy,
    .makes_with = nullptr,
    .offer = nullptr,
    .settle = nullptr,
    .uses_with = nullptr,
    .scenes = nullptr,
    .scene_count = 0,
    .reserved_too = 0,
};

}  // namespace

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t)
{
    return &effect;
}
