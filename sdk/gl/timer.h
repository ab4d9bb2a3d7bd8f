#pragma once
#include <memory>
#include <vector>

#include <epoxy/gl.h>

#include "plan/backend.h"
#include "gl/disposal.h"

namespace brume::gl {

// Timestamps, which may be taken inside the host's own timer queries. Two frames take turns, so that the results of the
// last ended one survive while the next is recorded.
class GlTimer : public FrameTimer {
public:
    explicit GlTimer(std::shared_ptr<Disposal> disposal) : disposal_(std::move(disposal)) {}
    ~GlTimer() override;

    void begin() override;
    void mark(int entry) override;
    void end() override;
    std::vector<double> milliseconds(int entries) override;

private:
    struct Frame {
        std::vector<GLuint> queries;  // reused; the first entries.size() are this frame's
        std::vector<int> entries;
    };

    const std::shared_ptr<Disposal> disposal_;
    Frame recording_, ended_;
};

}  // namespace brume::gl
