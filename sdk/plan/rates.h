#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace brume {

class Backend;

// What a pass does a frame, by kind: see brume_plugin_entry.
struct Work {
    uint64_t operations = 0, alike = 0, turns = 0;
};

// Of one thread, at the backend's nominal rates.
double nanoseconds(const Backend &backend, const Work &work);

// What a pass takes a frame: a start, which small images do not hide, and what grows with its operations.
struct Rate {
    double start_ms = 0;
    double ms_per_operation = 0;
};

// What passes take on one device: nominal rates, or those that a calibration measured.
class Rates {
public:
    bool measured() const { return !rates_.empty(); }
    double milliseconds(const Backend &backend, const std::string &effect, const std::string &pass, uint64_t operations,
                        uint64_t bytes) const;
    void set(const std::string &effect, const std::string &pass, Rate rate) { rates_[effect + "/" + pass] = rate; }

    // JSON that names the device; "" before a calibration. read() throws Error(BRUME_ERROR_ARGUMENT) where the text is not
    // of this version and device, and changes nothing then.
    std::string write(const Backend &backend) const;
    void read(const Backend &backend, const std::string &text);

private:
    std::map<std::string, Rate> rates_;
};

}  // namespace brume
