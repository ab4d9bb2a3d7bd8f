#include "exr/output_stream.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {

OutputStream::OutputStream(const std::string &path, const std::string &final_name)
    : Imf::OStream(final_name.c_str()), file_(std::fopen(path.c_str(), "wb"))
{
    if (!file_)
        fail();
}

void OutputStream::fail()
{
    if (error_ == 0)
        error_ = errno ? errno : EIO;
    throw FrameError(fmt::format("{}: cannot be written: {}", fileName(), std::strerror(error_)));
}

void OutputStream::write(const char bytes[], int count)
{
    if (std::fwrite(bytes, 1, std::size_t(count), file_.get()) != std::size_t(count))
        fail();
}

std::uint64_t OutputStream::tellp()
{
    return std::uint64_t(::ftello(file_.get()));
}

void OutputStream::seekp(std::uint64_t position)
{
    if (::fseeko(file_.get(), off_t(position), SEEK_SET) != 0)
        fail();
}

void OutputStream::close()
{
    if (error_ != 0 || std::fflush(file_.get()) != 0)
        fail();
    if (std::fclose(file_.release()) != 0)
        fail();
}

void write_whole(const std::filesystem::path &output, const std::function<void(OutputStream &)> &write)
{
    PendingFile pending(output);
    OutputStream stream(pending.path().string(), output.string());
    try {
        write(stream);
    } catch (const FrameError &) {
        throw;
    } catch (const std::exception &e) {
        throw FrameError(fmt::format("{}: writing: {}", output.string(), e.what()));
    }
    stream.close();
    pending.commit();
}

}  // namespace brume::tool
