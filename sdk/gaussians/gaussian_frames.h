#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gaussians/gaussian.h"

namespace brume {

// Gaussians of a file per frame. Plans that run at once share it.
class GaussianFrames {
public:
    // `name` holds one frame number: %04d, %d or #### (one digit each; a lone # is four).
    explicit GaussianFrames(std::string name);
    // Whether there is a frame number in it; throws Error where there are two.
    static bool has_frame_number(const std::string &name);

    // Those of the file of the frame's whole part; throws Error where it cannot be read.
    std::shared_ptr<const std::vector<Gaussian>> at(double frame) const;

private:
    std::string before_, after_;
    int digits_ = 0;

    mutable std::mutex mutex_;
    mutable int cached_frame_ = 0;
    mutable std::shared_ptr<const std::vector<Gaussian>> cached_;  // the last that was read
};

}  // namespace brume
