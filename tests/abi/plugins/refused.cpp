// Plugins that the loader must refuse: one library per defect, named by TEST_CASE.
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <brume/brume_plugin.h>

namespace {

constexpr std::string_view test_case = TEST_CASE;

// What a later header's longer struct looks like to this library.
struct Table {
    brume_effect effect;
    uint64_t beyond = 0;
};

brume_status plan(const brume_services *, brume_host, const brume_plugin_request *, void **)
{
    return BRUME_OK;
}

brume_status execute(const brume_services *, brume_host, void *, const brume_plugin_frame *)
{
    return BRUME_OK;
}

void destroy(void *) {}

std::array<char, 8192> endless;

std::array<brume_parameter_info, 2> parameters{{
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0.0, 1.0, 0.5, "first", "", "First", "", ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0.0, 1.0, 0.5, "second", "", "Second", "", ""},
}};

std::array<brume_layer_info, 2> layers{{
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 3, 0, "normals", "Normals"},
    {sizeof(brume_layer_info), BRUME_LAYER_OUTPUT, 1, 0, "weight", "Weight"},
}};
std::array<const char *, 2> makes{"first_product", "second_product"}, uses{"density", "lights"};

Table table{{
    .struct_size = sizeof(brume_effect),
    .abi = BRUME_PLUGIN_ABI,
    .name = "refused",
    .help = "Is refused",
    .order = 200,
    .thread_safety = BRUME_THREADS_SAFE,
    .wanted = BRUME_WANTED_NEVER,
    .parameter_count = 2,
    .layer_count = 2,
    .make_count = 2,
    .use_count = 2,
    .reserved = 0,
    .parameters = parameters.data(),
    .layers = layers.data(),
    .makes = makes.data(),
    .uses = uses.data(),
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
}};

void make_choice(const char *choices, double default_number)
{
    parameters[1].type = BRUME_PARAMETER_CHOICE;
    parameters[1].choices = choices;
    parameters[1].default_number = default_number;
}

void break_effect(brume_effect &effect)
{
    if (test_case == "wrong_abi")
        effect.abi = BRUME_PLUGIN_ABI + 98;
    if (test_case == "struct_size_zero")
        effect.struct_size = 0;
    if (test_case == "struct_size_huge")
        effect.struct_size = 0xffffffffu;
    if (test_case == "unknown_fields") {
        effect.struct_size = sizeof(Table);
        table.beyond = 1;
    }
    if (test_case == "bad_name")
        effect.name = "Bad Name";
    if (test_case == "null_name")
        effect.name = nullptr;
    if (test_case == "null_help")
        effect.help = nullptr;
    if (test_case == "two_lines")
        effect.help = "One line\nand another";
    if (test_case == "not_utf8")
        effect.help = "caf\xe9";
    if (test_case == "endless_help") {
        endless.fill('a');
        effect.help = endless.data();
    }
    if (test_case == "null_execute")
        effect.execute = nullptr;
    if (test_case == "bad_thread_safety")
        effect.thread_safety = 7;
    if (test_case == "bad_wanted")
        effect.wanted = 7;
    if (test_case == "too_many_layers")
        effect.layer_count = 65;
    if (test_case == "null_layers")
        effect.layers = nullptr;
    if (test_case == "too_many_makes")
        effect.make_count = 65;
    if (test_case == "null_makes")
        effect.makes = nullptr;
    if (test_case == "too_many_uses")
        effect.use_count = 65;
    if (test_case == "billion_parameters")
        effect.parameter_count = 1000000000u;
    if (test_case == "null_parameters")
        effect.parameters = nullptr;
}

void break_parameter(brume_parameter_info &parameter)
{
    if (test_case == "null_parameter_name")
        parameter.name = nullptr;
    if (test_case == "duplicate_parameter")
        parameter.name = "first";
    if (test_case == "nan_default")
        parameter.default_number = std::numeric_limits<double>::quiet_NaN();
    if (test_case == "default_out_of_range")
        parameter.default_number = 2.0;
    if (test_case == "infinite_range")
        parameter.maximum = std::numeric_limits<double>::infinity();
    if (test_case == "half_integer")
        parameter.type = BRUME_PARAMETER_INTEGER;
    if (test_case == "bad_type")
        parameter.type = 99;
    if (test_case == "empty_choice")
        make_choice("paper||reference", 0.0);
    if (test_case == "choice_twice")
        make_choice("paper|paper", 0.0);
    if (test_case == "default_choice_missing")
        make_choice("paper|reference", 2.0);
    if (test_case == "choices_of_number")
        parameter.choices = "paper|reference";
    if (test_case == "bad_stride")
        parameter.struct_size = 7;
}

void break_layer(brume_layer_info &layer)
{
    if (test_case == "null_layer_name")
        layer.name = nullptr;
    if (test_case == "bad_layer_name")
        layer.name = "Depth Of Field";
    if (test_case == "null_layer_help")
        layer.help = nullptr;
    if (test_case == "layer_without_direction")
        layer.flags = 0;
    if (test_case == "layer_of_both_directions")
        layer.flags = BRUME_LAYER_INPUT | BRUME_LAYER_OUTPUT;
    if (test_case == "unknown_layer_flag")
        layer.flags = BRUME_LAYER_OUTPUT | 0x100;
    if (test_case == "needed_output")
        layer.flags = BRUME_LAYER_OUTPUT | BRUME_LAYER_NEEDED;
    if (test_case == "layer_of_two_channels")
        layer.channels = 2;
    if (test_case == "duplicate_layer")
        layer = layers[0];
    if (test_case == "bad_layer_stride")
        layer.struct_size = 12;
}

void break_products()
{
    if (test_case == "null_make")
        makes[1] = nullptr;
    if (test_case == "bad_make")
        makes[1] = "Second";
    if (test_case == "make_twice")
        makes[1] = makes[0];
    if (test_case == "null_use")
        uses[1] = nullptr;
    if (test_case == "use_twice")
        uses[1] = uses[0];
}

}  // namespace

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t)
{
    if (test_case == "null_table")
        return nullptr;
    if (test_case == "throws_in_entry")
        throw std::runtime_error("thrown in entry");
    if (test_case == "throws_int_in_entry")
        throw 42;
    break_effect(table.effect);
    break_parameter(parameters[1]);
    break_layer(layers[1]);
    break_products();
    return &table.effect;
}
