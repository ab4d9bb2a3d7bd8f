#include "plan/services.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "base/error.h"
#include "plan/plan.h"

namespace brume {
namespace {

template <class Function> brume_status guarded(brume_host host, Function function)
{
    if (!host)
        return BRUME_ERROR_ARGUMENT;
    try {
        function();
        return BRUME_OK;
    } catch (const Error &error) {
        return host->fail(error.status(), error.what());
    } catch (const std::bad_alloc &) {
        return host->fail(BRUME_ERROR_MEMORY, "out of memory");
    } catch (const std::exception &error) {
        return host->fail(BRUME_ERROR_INTERNAL, error.what());
    }
}

// A plugin of a later header says a larger size and is served too.
template <class Struct> void expect_struct(const Struct *given, size_t least, const char *what)
{
    if (!given || given->struct_size < least)
        throw Error(BRUME_ERROR_ARGUMENT, std::string(what) + ": NULL or struct_size too small");
}

// As this library knows it: what the plugin's header did not have yet is 0.
brume_plugin_entry copied(const brume_plugin_entry *entry)
{
    expect_struct(entry, offsetof(brume_plugin_entry, alike), "add_entry");
    brume_plugin_entry copy{};
    std::memcpy(&copy, entry, std::min<size_t>(entry->struct_size, sizeof copy));
    return copy;
}

}  // namespace

const brume_services &services()
{
    static const brume_services table{
        sizeof(brume_services),
        0,
        [](brume_host host, brume_status status, const char *message) {
            return host ? host->fail(status, message) : status;
        },
        [](brume_host host, const brume_plugin_entry *entry) {
            return guarded(host, [&] { host->add_entry(copied(entry)); });
        },
        [](brume_host host, uint32_t needs, const char *reason) {
            return guarded(host, [&] { host->need_camera(needs, reason ? reason : ""); });
        },
        [](brume_host host, const char *label, int32_t width, int32_t height, int32_t channels, brume_plugin_image *out) {
            return guarded(host, [&] {
                if (!out)
                    throw Error(BRUME_ERROR_ARGUMENT, "create_image: out is NULL");
                *out = host->create_image(label, width, height, channels);
            });
        },
        [](brume_host host, const brume_pass_desc *desc, brume_pass *out) {
            return guarded(host, [&] {
                expect_struct(desc, sizeof *desc, "create_pass");
                if (!out)
                    throw Error(BRUME_ERROR_ARGUMENT, "create_pass: out is NULL");
                *out = host->create_pass(*desc);
            });
        },
        [](brume_host host, const char *product) { return host && product ? host->made(product) : BRUME_MADE_NOWHERE; },
        [](brume_host host, brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width,
           int32_t height, void *user) {
            brume_status result = BRUME_OK;
            brume_status status = guarded(host, [&] {
                try {
                    result = host->run(pass, images, constants, width, height, user);
                } catch (const Error &) {
                    throw;
                } catch (const std::bad_alloc &) {
                    throw;
                } catch (const std::exception &error) {
                    throw Error(BRUME_ERROR_PLUGIN, std::string("threw in a loop over rows: ") + error.what());
                } catch (...) {
                    throw Error(BRUME_ERROR_PLUGIN, "threw in a loop over rows");
                }
            });
            return status != BRUME_OK ? status : result;
        },
        [](brume_host host, uint32_t slot, int32_t channels, const float *values, uint64_t texels, brume_plugin_image *out) {
            return guarded(host, [&] {
                if (!out || (!values && texels > 0))
                    throw Error(BRUME_ERROR_ARGUMENT, "upload: values or out is NULL");
                *out = host->upload(slot, channels, values, texels);
            });
        },
        [](brume_host host, const char *product, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
           uint64_t revision) {
            return guarded(host, [&] { host->publish(product, images, image_count, count, revision); });
        },
        [](brume_host host, const brume_plugin_entry *entry) {
            double taken = 0;
            guarded(host, [&] { taken = host->nanoseconds(copied(entry)); });
            return taken;
        },
    };
    return table;
}

}  // namespace brume
