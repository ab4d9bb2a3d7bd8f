#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace brume::test {

// Counts what is asked of OpenGL while one of these lives: glGet..., glIs... and glGetError, by the name of the function.
class QueryCount {
public:
    QueryCount();
    ~QueryCount();
    QueryCount(const QueryCount &) = delete;
    QueryCount &operator=(const QueryCount &) = delete;

    static int of(const std::string &function);
    static int total();
    static std::string list();

private:
    static std::map<std::string, int> calls();
};

// What the textures hold that are made while this lives, by their storage: until they are deleted.
class TextureBytes {
public:
    TextureBytes();
    ~TextureBytes();
    TextureBytes(const TextureBytes &) = delete;
    TextureBytes &operator=(const TextureBytes &) = delete;

    static uint64_t held();
};

}  // namespace brume::test
