#include "frames/range.hpp"

#include <charconv>
#include <cstdlib>
#include <unordered_set>

#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;

class Parser {
public:
    explicit Parser(const std::string &text) : text_(text), at_(text.data()), end_(at_ + text.size()) {}

    std::vector<int> parse()
    {
        do
            item();
        while (take(','));
        if (at_ != end_)
            fail();
        return frames_;
    }

private:
    [[noreturn]] void fail() const
    {
        throw RequestError(
            fmt::format("--frames '{}': expected frames such as 7, 1-100, 1-100x2 or 1-10,20 (at character {})", text_,
                        at_ - text_.data() + 1));
    }

    bool take(char c)
    {
        if (at_ == end_ || *at_ != c)
            return false;
        ++at_;
        return true;
    }

    int number()
    {
        int value = 0;
        const auto [next, error] = std::from_chars(at_, end_, value);
        if (error != std::errc())
            fail();
        at_ = next;
        return value;
    }

    void add(long long frame)
    {
        if (frames_.size() >= kMostFrames)
            throw RequestError(fmt::format("--frames '{}': more than {} frames", text_, kMostFrames));
        if (seen_.insert(int(frame)).second)
            frames_.push_back(int(frame));
    }

    void item()
    {
        const long long first = number();
        if (!take('-'))
            return add(first);
        const long long last = number();
        long long step = first <= last ? 1 : -1;
        bool complement = false;
        if ((at_ != end_) && (*at_ == 'x' || *at_ == 'y')) {
            complement = *at_++ == 'y';
            step = number();
        }
        if (step == 0 || (last - first) * step < 0)
            fail();
        if (std::llabs((last - first) / step) >= (long long)kMostFrames)
            throw RequestError(fmt::format("--frames '{}': more than {} frames", text_, kMostFrames));
        const long long direction = step > 0 ? 1 : -1;
        if (!complement)
            for (long long f = first; (last - f) * direction >= 0; f += step)
                add(f);
        else
            for (long long f = first; (last - f) * direction >= 0; f += direction)
                if ((f - first) % step != 0)
                    add(f);
    }

    const std::string &text_;
    const char *at_;
    const char *end_;
    std::vector<int> frames_;
    std::unordered_set<int> seen_;
};

}  // namespace

std::vector<int> parse_frames(const std::string &text)
{
    return Parser(text).parse();
}

}  // namespace brume::tool
