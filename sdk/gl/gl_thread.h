#pragma once
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
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
    using Task = std::packaged_task<void()>;
    void serve(std::promise<void> started);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::queue<Task> tasks_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace brume::gl
