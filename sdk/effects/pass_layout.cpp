#include "effects/pass_layout.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"

namespace brume {
namespace {

// As many of a compute shader as every OpenGL 4.5 has.
constexpr uint32_t most_read = 16, most_written = 8;
constexpr uint32_t most_slots = 32, most_constants = 256, largest_constants = 16384;

template <class... Arguments>
[[noreturn]] void refuse(const std::string &pass, fmt::format_string<Arguments...> format, Arguments &&...arguments)
{
    throw Error(BRUME_ERROR_ARGUMENT,
                fmt::format("pass \"{}\": {}", pass, fmt::format(format, std::forward<Arguments>(arguments)...)));
}

template <class Item>
std::string name_of(const std::string &pass, const char *table, uint32_t index, const char *name,
                    const std::vector<Item> &earlier)
{
    const std::string what = fmt::format("{}[{}]", table, index);
    if (!name || !*name)
        refuse(pass, "{}: its name is {}; expected that of a uniform", what, name ? "empty" : "NULL");
    if (std::string_view(name).starts_with("brume_"))
        refuse(pass, "{} \"{}\": names that start with brume_ are the host's", what, name);
    if (std::any_of(earlier.begin(), earlier.end(), [&](const Item &item) { return item.name == name; }))
        refuse(pass, "{} \"{}\": is there twice", what, name);
    return name;
}

}  // namespace

PassLayout layout_of(const brume_pass_desc &desc)
{
    PassLayout layout;
    if (!desc.name)
        throw Error(BRUME_ERROR_ARGUMENT, "create_pass: its name is NULL");
    layout.name = desc.name;
    if (desc.slot_count > most_slots || (desc.slot_count > 0 && !desc.slots))
        refuse(layout.name, "{} slots{}; expected at most {}", desc.slot_count, desc.slots ? "" : ", but slots is NULL",
               most_slots);
    if (desc.constant_count > most_constants || (desc.constant_count > 0 && !desc.constants))
        refuse(layout.name, "{} constants{}; expected at most {}", desc.constant_count,
               desc.constants ? "" : ", but constants is NULL", most_constants);
    if (desc.constant_size > largest_constants)
        refuse(layout.name, "constants of {} bytes; expected at most {}", desc.constant_size, largest_constants);
    if (desc.rows && desc.grain < 1)
        refuse(layout.name, "grain {}; expected at least 1", desc.grain);
    for (uint32_t i = 0; i < desc.slot_count; ++i) {
        const brume_slot &slot = desc.slots[i];
        std::string name = name_of(layout.name, "slots", i, slot.name, layout.slots);
        if (slot.access > BRUME_ACCESS_WRITE)
            refuse(layout.name, "slots[{}] \"{}\": access {}; expected BRUME_ACCESS_FETCH, _LINEAR or _WRITE", i, name,
                   slot.access);
        layout.slots.push_back({std::move(name), slot.access});
    }
    const auto written = uint32_t(std::count_if(layout.slots.begin(), layout.slots.end(),
                                                [](const auto &slot) { return slot.access == BRUME_ACCESS_WRITE; }));
    if (written > most_written || desc.slot_count - written > most_read)
        refuse(layout.name, "{} slots to read and {} to write; expected at most {} and {}, which every OpenGL 4.5 has",
               desc.slot_count - written, written, most_read, most_written);
    layout.constant_size = desc.constant_size;
    for (uint32_t i = 0; i < desc.constant_count; ++i) {
        const brume_constant &constant = desc.constants[i];
        std::string name = name_of(layout.name, "constants", i, constant.name, layout.constants);
        if (constant.type > BRUME_CONSTANT_INT)
            refuse(layout.name, "constants[{}] \"{}\": type {}; expected BRUME_CONSTANT_FLOAT or _INT", i, name,
                   constant.type);
        if (constant.components < 1 || constant.components > 4)
            refuse(layout.name, "constants[{}] \"{}\": {} components; expected 1 to 4", i, name, constant.components);
        if (constant.count < 1 || constant.count > largest_constants)
            refuse(layout.name, "constants[{}] \"{}\": count {}; expected at least 1", i, name, constant.count);
        PassLayout::Constant copy{std::move(name), constant.type, constant.components, constant.count, constant.offset};
        if (copy.offset > layout.constant_size || copy.bytes() > layout.constant_size - copy.offset)
            refuse(layout.name, "constants[{}] \"{}\": {} bytes at {}; expected them within the struct's {}", i, copy.name,
                   copy.bytes(), copy.offset, layout.constant_size);
        layout.constants.push_back(std::move(copy));
    }
    return layout;
}

}  // namespace brume
