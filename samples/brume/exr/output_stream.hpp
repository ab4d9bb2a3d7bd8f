#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <ImfIO.h>

namespace brume::tool {

/// OpenEXR writes a file's chunk table from a destructor that swallows errors, so a full disk could pass unnoticed.
/// This stream remembers any failure until close().
class OutputStream : public Imf::OStream {
public:
    /// Errors name `final_name`: `path` is a temporary one.
    OutputStream(const std::string &path, const std::string &final_name);

    void write(const char bytes[], int count) override;
    std::uint64_t tellp() override;
    void seekp(std::uint64_t position) override;

    /// Throws FrameError if anything written since the beginning did not reach the file.
    void close();

private:
    struct Closer {
        void operator()(std::FILE *file) const { std::fclose(file); }
    };
    [[noreturn]] void fail();

    std::unique_ptr<std::FILE, Closer> file_;
    int error_ = 0;
};

/// Whole under its name or not at all. Throws FrameError that names it.
void write_whole(const std::filesystem::path &output, const std::function<void(OutputStream &)> &write);

}  // namespace brume::tool
