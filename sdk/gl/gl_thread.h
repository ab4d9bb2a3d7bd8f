#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace brume::gl {

// A thread with a headless context of its own, so that the caller's threads and current contexts are never touched.
class GlThread {
public:
    // Throws what making the context threw.
    GlThread();
    // Ends the thread and the context with all its objects.
    ~GlThread();

    // Runs `work` there and waits; exceptions come back. From that thread itself: runs it at once.
    void invoke(const std::function<void()> &work);

private:
    void serve();

    std::mutex mutex_;
    std::condition_variable changed_;
    const std::function<void()> *work_ = nullptr;  // one caller's at a time
    bool ready_ = false;                           // the context is made, or failed to be; then: `work_` is done
    bool ending_ = false;
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace brume::gl
