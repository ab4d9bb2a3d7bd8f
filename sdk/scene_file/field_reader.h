#pragma once
#include <filesystem>

#include "base/json_node.h"
#include "scene/fields.h"

namespace brume {

double read_constant(const JsonNode &node, const Range &range);

// How each type of member is read, or JsonNode's error.
struct FieldReader {
    const JsonNode &node;
    const std::filesystem::path &folder;  // files are relative to it
    Range range;
    uint32_t traits;

    void operator()(bool &to) const { to = node.boolean(); }
    void operator()(double &to) const { to = read_constant(node, range); }
    void operator()(uint32_t &to) const;
    void operator()(std::string &to) const
    {
        const std::string &name = node.string("the name of an image");
        if (name.empty())
            node.expected("the name of an image");
        to = (folder / name).string();
    }
    void operator()(Number &to) const;
    void operator()(std::array<Number, 2> &to) const;
    void operator()(Number3 &to) const;
    void operator()(Matrix &to) const;
    void operator()(std::optional<Number> &to) const { (*this)(to.emplace()); }
    void operator()(std::optional<Matrix> &to) const;
};

}  // namespace brume
