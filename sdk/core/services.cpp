#include "core/services.h"

#include "core/error.h"
#include "core/plan.h"

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

template <class Struct> void expect_struct(const Struct *given, const char *what)
{
    // There is one version of these structs so far; a plugin of a later header says a larger size and is served too.
    if (!given || given->struct_size < sizeof(Struct))
        throw Error(BRUME_ERROR_ARGUMENT, std::string(what) + ": NULL or struct_size too small");
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
            return guarded(host, [&] {
                expect_struct(entry, "add_entry");
                host->add_entry(*entry);
            });
        },
        [](brume_host host, uint32_t needs, const char *reason) {
            return guarded(host, [&] { host->need_camera(needs, reason ? reason : ""); });
        },
        [](brume_host host, const char *label, int32_t width, int32_t height, int32_t channels, brume_plugin_image *out) {
            return guarded(host, [&] {
                if (!out)
                    throw Error(BRUME_ERROR_ARGUMENT, "create_image: out is NULL");
                try {
                    *out = host->create_image(width, height, channels);
                } catch (const Error &error) {
                    throw Error(error.status(), "image " + std::string(label ? label : "?") + ": " + error.what());
                }
            });
        },
        [](brume_host host, const char *name, const char *source, const char *defines, brume_program *out) {
            return guarded(host, [&] {
                if (!name || !source || !out)
                    throw Error(BRUME_ERROR_ARGUMENT, "compile: name, source or out is NULL");
                *out = host->compile(name, source, defines ? defines : "");
            });
        },
        [](brume_host host, const brume_plugin_pass *pass) {
            return guarded(host, [&] {
                expect_struct(pass, "run");
                host->run(*pass);
            });
        },
        [](brume_host host, const char *name, int32_t count, int32_t grain, brume_rows_function function, void *user) {
            brume_status result = BRUME_OK;
            brume_status status = guarded(host, [&] {
                try {
                    result = host->rows(name, count, grain, function, user);
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
        [](brume_host host, brume_plugin_image image, brume_plugin_pixels *out) {
            return guarded(host, [&] {
                if (!image || !out)
                    throw Error(BRUME_ERROR_ARGUMENT, "pixels: image or out is NULL");
                *out = host->pixels(image);
            });
        },
        [](brume_host host, uint32_t slot, int32_t channels, const float *values, uint64_t texels, brume_plugin_image *out) {
            return guarded(host, [&] {
                if (!out || (!values && texels > 0))
                    throw Error(BRUME_ERROR_ARGUMENT, "upload: values or out is NULL");
                *out = host->upload(slot, channels, values, texels);
            });
        },
    };
    return table;
}

}  // namespace brume
