#pragma once
#include <algorithm>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/value_name.h"

namespace brume::api {

// Larger than any struct will ever be: beyond it a size is uninitialised memory, and the tail is not to be read.
constexpr uint32_t largest_struct = 1024;

// The size that the caller gave; refuses one that cannot be, and bytes past the end known here that say something.
template <class Struct> uint32_t checked_size(const Struct *given, const ValueName &name)
{
    if (!given)
        throw Error(BRUME_ERROR_ARGUMENT, name.text() + ": NULL");
    uint32_t size;  // by bytes: an array of structs of an odd size leaves its elements unaligned
    std::memcpy(&size, given, sizeof size);
    if (size < sizeof(uint32_t) || size > largest_struct)
        throw Error(BRUME_ERROR_ARGUMENT,
                    name.text() + ".struct_size: " + std::to_string(size) + "; expected sizeof, as its INIT macro sets it");
    auto bytes = reinterpret_cast<const unsigned char *>(given);
    for (size_t i = sizeof(Struct); i < size; ++i)
        if (bytes[i] != 0)
            throw Error(BRUME_ERROR_ARGUMENT, name.text() + ".struct_size: " + std::to_string(size) +
                                                  " with nonzero bytes past the " + std::to_string(sizeof(Struct)) +
                                                  " this library knows");
    return size;
}

// Size-tagged structs: defaults first, then every field that lies wholly inside the size the caller gave.
template <class Struct, class... Fields>
Struct read_struct(const Struct *given, const Struct &defaults, const ValueName &name, Fields Struct::*...fields)
{
    const uint32_t size = checked_size(given, name);
    auto bytes = reinterpret_cast<const unsigned char *>(given);
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

// Element i of a caller's array, whose stride is the size that its first element names.
template <class Struct> const Struct *element(const Struct *first, size_t i)
{
    return reinterpret_cast<const Struct *>(reinterpret_cast<const unsigned char *>(first) + i * first->struct_size);
}

// Fills as much of the caller's struct as it has room for.
template <class Struct> void write_struct(Struct *out, Struct value, const ValueName &name)
{
    const uint32_t size = checked_size(out, name);
    value.struct_size = size;
    std::memcpy(static_cast<void *>(out), &value, std::min<size_t>(size, sizeof(Struct)));
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
