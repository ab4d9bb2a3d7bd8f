#include "base/whole_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/text.h"

namespace brume {
namespace fs = std::filesystem;

std::string read_whole_file(const std::string &path, size_t limit)
{
    auto fail = [&](const std::string &what) { throw Error(BRUME_ERROR_SCENE, path + ": " + what); };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error)
        fail("cannot be read: " + error.message());
    // A pipe or a device has no size to check and may never end.
    if (!fs::is_regular_file(status))
        fail("not a file");
    const uintmax_t size = fs::file_size(path, error);
    if (error)
        fail("cannot be read: " + error.message());
    if (size > limit)
        fail(fmt::format("{} bytes; expected {} at most", size, limit));
    std::string content(size_t(size), '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(content.data(), std::streamsize(content.size())))
        fail(std::string("cannot be read: ") + std::strerror(errno));
    return content;
}

void write_whole_file(const std::string &path, std::string_view content)
{
    static std::atomic<unsigned> serial{0};
    const fs::path final = path;
    const std::string name = fmt::format(".{}.{}-{}.partial", final.filename().string(), ::getpid(), serial++);
    const std::string temporary = (final.parent_path() / name).string();
    auto fail = [&](int number) {
        const std::string why = std::strerror(number);
        ::unlink(temporary.c_str());
        throw Error(BRUME_ERROR_ARGUMENT, path + ": cannot be written: " + why);
    };
    std::unique_ptr<FILE, int (*)(FILE *)> file(std::fopen(temporary.c_str(), "wbx"), std::fclose);
    if (!file)
        throw Error(BRUME_ERROR_ARGUMENT, path + ": cannot be written: " + std::strerror(errno));
    errno = 0;
    if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() || std::fclose(file.release()) != 0)
        fail(errno);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
        fail(errno);
}

}  // namespace brume
