// Effects that misbehave when they end, settle or choose, and one that counts overlapping calls: one library per case, named
// by TEST_CASE.
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include <brume/brume_plugin.h>

namespace {

constexpr std::string_view test_case = TEST_CASE;
std::atomic<int> inside = 0, plans = 0;

struct Alone {
    bool alone = ++inside == 1;
    Alone() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }
    ~Alone() { --inside; }
};

brume_status settle(const brume_services *services, brume_host host, const brume_plugin_request *, double *)
{
    Alone now;
    if (test_case == "throws_settling")
        throw std::runtime_error("thrown in settle");
    return now.alone ? BRUME_OK : services->fail(host, BRUME_ERROR_PLUGIN, "called twice at once");
}

// Says how many plans there were; runs in a medium that absorbs much.
brume_status plan_sleeper(const brume_services *services, brume_host host, const brume_plugin_scene &scene)
{
    const std::string reason = std::to_string(++plans);
    if (scene.gaussian_count > 100)
        return services->fail(host, BRUME_ERROR_PLUGIN, "too many Gaussians to look at each frame");
    const brume_plugin_entry entry{
        sizeof(brume_plugin_entry), scene.medium->absorption[0] > 0.5f, "pass", reason.c_str(), 0, 0, 0, 0};
    return services->add_entry(host, &entry);
}

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state)
{
    Alone now;
    if (test_case == "sleeper")
        return plan_sleeper(services, host, *request->scene);
    *state = &inside;
    if (test_case == "throws_destroying_and_planning")
        throw std::runtime_error("thrown in plan");
    const brume_plugin_entry entry{sizeof(brume_plugin_entry), 1, "pass", "always", 0, 0, 0, 0};
    if (!now.alone)
        return services->fail(host, BRUME_ERROR_PLUGIN, "called twice at once");
    return services->add_entry(host, &entry);
}

brume_status execute(const brume_services *services, brume_host host, void *, const brume_plugin_frame *)
{
    Alone now;
    return now.alone ? BRUME_OK : services->fail(host, BRUME_ERROR_PLUGIN, "called twice at once");
}

void destroy(void *)
{
    if (test_case == "throws_destroying" || test_case == "throws_destroying_and_planning")
        throw std::runtime_error("thrown in destroy");
    if (test_case == "throws_int_destroying")
        throw 42;
    Alone now;
}

constexpr const char *used[] = {"density"};

uint32_t uses_with(const double *, uint32_t)
{
    if (test_case == "throws_choosing")
        throw std::runtime_error("thrown in uses_with");
    return test_case != "uses_nothing";
}

const brume_effect effect{
    .struct_size = sizeof(brume_effect),
    .abi = BRUME_PLUGIN_ABI,
    .name = TEST_CASE,
    .help = "Ends badly",
    .order = 200,
    .thread_safety = BRUME_THREADS_UNSAFE,
    .wanted = BRUME_WANTED_NEVER,
    .parameter_count = 0,
    .layer_count = 0,
    .make_count = 0,
    .use_count = 1,
    .reserved = 0,
    .parameters = nullptr,
    .layers = nullptr,
    .makes = nullptr,
    .uses = used,
    .plan = plan,
    .execute = execute,
    .destroy = destroy,
    .makes_with = nullptr,
    .offer = nullptr,
    .settle = settle,
    .uses_with = uses_with,
    .scenes = nullptr,
    .scene_count = 0,
    .reserved_too = 0,
};

}  // namespace

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t)
{
    return &effect;
}
