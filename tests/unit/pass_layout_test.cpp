#include "effects/pass_layout.h"

#include <functional>

#include <gtest/gtest.h>

#include "base/error.h"

namespace brume {
namespace {

brume_status rows(const brume_plugin_rows *, int32_t, int32_t)
{
    return BRUME_OK;
}

struct Described {
    std::vector<brume_slot> slots{{"source", BRUME_ACCESS_FETCH, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    std::vector<brume_constant> constants{{"gain", BRUME_CONSTANT_FLOAT, 1, 1, 0},
                                          {"offsets[0].at", BRUME_CONSTANT_INT, 2, 3, 4}};
    brume_pass_desc desc{};

    Described()
    {
        desc.struct_size = sizeof desc;
        desc.name = "pass";
        desc.slot_count = 2;
        desc.constant_count = 2;
        desc.constant_size = 28;
        desc.rows = rows;
        desc.grain = 1;
    }
    PassLayout layout()
    {
        desc.slots = slots.data();
        desc.constants = constants.data();
        return layout_of(desc);
    }
};

TEST(PassLayout, IsWhatIsDescribed)
{
    const PassLayout layout = Described().layout();
    EXPECT_EQ(layout.name, "pass");
    ASSERT_EQ(layout.slots.size(), 2u);
    EXPECT_EQ(layout.slots[1].name, "target");
    EXPECT_EQ(layout.slots[1].access, BRUME_ACCESS_WRITE);
    ASSERT_EQ(layout.constants.size(), 2u);
    EXPECT_EQ(layout.constants[1].bytes(), 24u);
    EXPECT_EQ(layout.constants[1].offset, 4u);
    EXPECT_EQ(layout.constant_size, 28u);
}

TEST(PassLayout, MistakesAreNamed)
{
    const auto refused = [](const std::function<void(Described &)> &spoil, const std::string &part) {
        Described described;
        spoil(described);
        try {
            described.layout();
            ADD_FAILURE() << "nothing was thrown; expected " << part;
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), BRUME_ERROR_ARGUMENT);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
                << "no \"" << part << "\" in " << error.what();
        }
    };
    refused([](auto &d) { d.desc.name = nullptr; }, "name is NULL");
    refused([](auto &d) { d.desc.grain = 0; }, "pass \"pass\": grain 0; expected at least 1");
    refused([](auto &d) { d.desc.slot_count = 33; }, "33 slots; expected at most 32");
    auto with = [](Described &d, uint32_t access, uint32_t count) {
        static std::vector<std::string> kept;
        kept.clear();
        for (uint32_t i = 0; i < count; ++i)
            kept.emplace_back(1, char('a' + i));
        d.slots.clear();
        for (const std::string &name : kept)
            d.slots.push_back({name.c_str(), access, 0});
        d.desc.slot_count = count;
    };
    refused([&](auto &d) { with(d, BRUME_ACCESS_LINEAR, 17); },
            "pass \"pass\": 17 slots to read and 0 to write; expected at most 16 and 8, which every OpenGL 4.5 has");
    refused([&](auto &d) { with(d, BRUME_ACCESS_WRITE, 9); }, "0 slots to read and 9 to write");
    refused([](auto &d) { d.desc.constant_count = 257; }, "257 constants; expected at most 256");
    refused([](auto &d) { d.desc.constant_size = 1u << 20; }, "constants of 1048576 bytes; expected at most 16384");
    refused([](auto &d) { d.slots[1].name = nullptr; }, "slots[1]: its name is NULL");
    refused([](auto &d) { d.slots[1].name = ""; }, "slots[1]: its name is empty");
    refused([](auto &d) { d.slots[1].name = "source"; }, "slots[1] \"source\": is there twice");
    refused([](auto &d) { d.slots[1].name = "brume_depth"; },
            "slots[1] \"brume_depth\": names that start with brume_ are the host's");
    refused([](auto &d) { d.slots[0].access = 7; }, "slots[0] \"source\": access 7");
    refused([](auto &d) { d.constants[0].name = nullptr; }, "constants[0]: its name is NULL");
    refused([](auto &d) { d.constants[1].name = "gain"; }, "constants[1] \"gain\": is there twice");
    refused([](auto &d) { d.constants[0].name = "brume_grid"; }, "names that start with brume_");
    refused([](auto &d) { d.constants[0].type = 9; }, "constants[0] \"gain\": type 9");
    refused([](auto &d) { d.constants[0].components = 0; }, "0 components; expected 1 to 4");
    refused([](auto &d) { d.constants[0].components = 5; }, "5 components; expected 1 to 4");
    refused([](auto &d) { d.constants[0].count = 0; }, "count 0; expected at least 1");
    refused([](auto &d) { d.constants[1].offset = 8; }, "24 bytes at 8; expected them within the struct's 28");
    refused([](auto &d) { d.constants[1].offset = 0xfffffffcu; }, "24 bytes at 4294967292");
}

}  // namespace
}  // namespace brume
