#pragma once
#include <algorithm>
#include <cstring>
#include <string>

#include "core/error.h"

namespace brume::api {

// Size-tagged structs: defaults first, then every field that lies wholly inside the size the caller gave.
template <class Struct, class... Fields>
Struct read_struct(const Struct *given, const Struct &defaults, const char *name, Fields Struct::*...fields)
{
    if (!given)
        throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + ": NULL");
    uint32_t size = given->struct_size;
    if (size < sizeof(uint32_t))
        throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + ".struct_size: " + std::to_string(size) +
                                              "; expected sizeof, as its INIT macro sets it");
    auto bytes = reinterpret_cast<const unsigned char *>(given);
    for (size_t i = sizeof(Struct); i < size; ++i)
        if (bytes[i] != 0)
            throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + ".struct_size: " + std::to_string(size) +
                                                  " with nonzero bytes past the " + std::to_string(sizeof(Struct)) +
                                                  " this library knows");
    Struct result = defaults;
    auto take = [&](auto field) {
        size_t end = size_t(reinterpret_cast<const unsigned char *>(&(result.*field)) -
                            reinterpret_cast<const unsigned char *>(&result)) +
                     sizeof(result.*field);
        if (end <= size)
            std::memcpy(&(result.*field), bytes + end - sizeof(result.*field), sizeof(result.*field));
    };
    (take(fields), ...);
    return result;
}

// Fills as much of the caller's struct as it has room for.
template <class Struct> void write_struct(Struct *out, Struct value, const char *name)
{
    if (!out)
        throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + ": NULL");
    if (out->struct_size < sizeof(uint32_t))
        throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + ".struct_size: " + std::to_string(out->struct_size) +
                                              "; expected sizeof, as its INIT macro sets it");
    value.struct_size = out->struct_size;
    std::memcpy(static_cast<void *>(out), &value, std::min<size_t>(out->struct_size, sizeof(Struct)));
}

// Copies text out, cut to capacity and terminated; returns the bytes the whole needs.
inline size_t copy_text(const std::string &text, char *buffer, size_t capacity)
{
    if (buffer && capacity > 0) {
        size_t length = std::min(text.size(), capacity - 1);
        std::memcpy(buffer, text.data(), length);
        buffer[length] = '\0';
    }
    return text.size() + 1;
}

}  // namespace brume::api
