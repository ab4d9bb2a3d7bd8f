// An effect of the library's, as a host of a later header runs it: lights, Gaussians and products are longer structs there,
// with what this header does not know after them. One library per effect, which EFFECT_FILE names; its name begins with
// wide_.
#include <dlfcn.h>

#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <brume/brume_plugin.h>

namespace {

constexpr size_t longer = 24;

template <class T> class Longer {
public:
    Longer(const T *first, size_t count) : bytes_(first ? count * stride : 0, 0xff)
    {
        for (size_t i = 0; first && i < count; ++i)
            std::memcpy(&bytes_[i * stride], first + i, sizeof(T));
    }
    T *data() { return bytes_.empty() ? nullptr : reinterpret_cast<T *>(bytes_.data()); }
    T &operator[](size_t i) { return *reinterpret_cast<T *>(&bytes_[i * stride]); }

    static constexpr uint32_t stride = sizeof(T) + longer;

private:
    std::vector<unsigned char> bytes_;
};

struct LongerScene {
    explicit LongerScene(const brume_plugin_scene &given)
        : lights(given.lights, given.light_count), gaussians(given.gaussians, given.gaussian_count), scene(given)
    {
        scene.lights = lights.data();
        scene.light_size = lights.stride;
        scene.gaussians = gaussians.data();
        scene.gaussian_size = gaussians.stride;
    }
    LongerScene(const LongerScene &) = delete;

    Longer<brume_plugin_light> lights;
    Longer<brume_plugin_gaussian> gaussians;
    brume_plugin_scene scene;
};

const brume_effect *inner = nullptr;
const brume_services *services_of_host = nullptr;

std::mutex mutex;
std::map<brume_pass, brume_rows_function> rows_of;
thread_local const brume_plugin_scene *scene_of_frame = nullptr;

struct User {
    brume_rows_function rows;
    const brume_plugin_scene *scene;
    void *user;
};

brume_status rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const User &given = *static_cast<const User *>(call->user);
    brume_plugin_rows seen = *call;
    seen.scene = given.scene;
    seen.user = given.user;
    return given.rows(&seen, first, last);
}

brume_status create_pass(brume_host host, const brume_pass_desc *desc, brume_pass *out)
{
    brume_pass_desc described = *desc;
    if (desc->rows)
        described.rows = rows;
    const brume_status status = services_of_host->create_pass(host, &described, out);
    if (status == BRUME_OK) {
        std::lock_guard lock(mutex);
        rows_of[*out] = desc->rows;
    }
    return status;
}

brume_status run(brume_host host, brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width,
                 int32_t height, void *user)
{
    User given{nullptr, scene_of_frame, user};
    {
        std::lock_guard lock(mutex);
        given.rows = rows_of.at(pass);
    }
    return services_of_host->run(host, pass, images, constants, width, height, &given);
}

const brume_services *services_around(const brume_services *services)
{
    static const brume_services around = [&] {
        services_of_host = services;
        brume_services s = *services;
        s.create_pass = create_pass;
        s.run = run;
        return s;
    }();
    return &around;
}

// function(services, request) with the scene of longer structs.
template <class Function>
auto with_longer(const brume_services *services, const brume_plugin_request *request, Function function)
{
    const LongerScene longer_scene(*request->scene);
    brume_plugin_request seen = *request;
    seen.scene = &longer_scene.scene;
    return function(services_around(services), &seen);
}

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state)
{
    return with_longer(services, request, [&](auto around, auto seen) { return inner->plan(around, host, seen, state); });
}

uint32_t offer(const brume_services *services, brume_host host, const brume_plugin_request *request, uint32_t index,
               double *parameters, double *error)
{
    return with_longer(services, request,
                       [&](auto around, auto seen) { return inner->offer(around, host, seen, index, parameters, error); });
}

brume_status settle(const brume_services *services, brume_host host, const brume_plugin_request *request, double *parameters)
{
    return with_longer(services, request,
                       [&](auto around, auto seen) { return inner->settle(around, host, seen, parameters); });
}

brume_status execute(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame)
{
    const LongerScene longer_scene(*frame->scene);
    Longer<brume_plugin_product> products(frame->products, frame->product_count);
    for (uint32_t i = 0; i < frame->product_count; ++i)
        products[i].struct_size = products.stride;
    brume_plugin_frame seen = *frame;
    seen.scene = &longer_scene.scene;
    seen.products = products.data();
    scene_of_frame = &longer_scene.scene;
    const brume_status status = inner->execute(services_around(services), host, state, &seen);
    scene_of_frame = nullptr;
    return status;
}

brume_effect around(const brume_effect &effect)
{
    static const std::string name = std::string("wide_") + effect.name;
    brume_effect e = effect;
    e.name = name.c_str();
    e.wanted = BRUME_WANTED_NEVER;
    e.plan = plan;
    e.execute = execute;
    e.offer = effect.offer ? offer : nullptr;
    e.settle = effect.settle ? settle : nullptr;
    return e;
}

}  // namespace

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    static void *const library = dlopen(EFFECT_FILE, RTLD_NOW | RTLD_LOCAL);
    const auto entry =
        library ? reinterpret_cast<brume_plugin_effect_function>(dlsym(library, BRUME_PLUGIN_ENTRY)) : nullptr;
    inner = entry ? entry(host_abi) : nullptr;
    if (!inner)
        return nullptr;
    static const brume_effect effect = around(*inner);
    return &effect;
}
