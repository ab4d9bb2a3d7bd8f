#pragma once
#include <map>
#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace brume::test {

// The state of the current context that a host could lose: by name, with indices for units.
using HostState = std::map<std::string, std::vector<double>>;

HostState read_state(bool compatibility);

// Objects that keep the dirtied state alive.
struct DirtyState {
    std::vector<GLuint> textures;
    GLuint program, pipeline, sampler, pack, unpack, storage, vertex_array, framebuffer;
};
// Every listed piece of state, and its neighbours, at values that are not the initial ones.
DirtyState dirty_state(bool compatibility);

// "name: before -> after" of each difference.
std::string difference(const HostState &before, const HostState &after);

}  // namespace brume::test
