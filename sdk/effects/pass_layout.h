#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <brume/brume_plugin.h>

namespace brume {

// What a pass reads, writes and is told, checked and copied from a plugin's description.
struct PassLayout {
    struct Slot {
        std::string name;
        uint32_t access = BRUME_ACCESS_FETCH;
    };
    struct Constant {
        std::string name;
        uint32_t type = BRUME_CONSTANT_FLOAT;
        uint32_t components = 1, count = 1, offset = 0;

        uint32_t bytes() const { return components * count * 4; }
    };

    std::string name;  // of the plan's entry
    std::vector<Slot> slots;
    std::vector<Constant> constants;
    uint32_t constant_size = 0;
};

// Throws Error(BRUME_ERROR_ARGUMENT) that names the pass and the slot or constant.
PassLayout layout_of(const brume_pass_desc &desc);

}  // namespace brume
