#include "gl/gl_thread.h"

#include "core/log.h"
#include "gl/egl_context.h"

namespace brume::gl {

GlThread::GlThread()
{
    std::promise<void> started;
    std::future<void> ready = started.get_future();
    thread_ = std::thread(&GlThread::serve, this, std::move(started));
    try {
        ready.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

GlThread::~GlThread()
{
    {
        std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void GlThread::invoke(const std::function<void()> &work)
{
    if (std::this_thread::get_id() == thread_.get_id())
        return work();
    std::vector<DeferredLog::Message> messages;
    Task task([&] {
        DeferredLog log;
        try {
            work();
        } catch (...) {
            messages = log.take();
            throw;
        }
        messages = log.take();
    });
    std::future<void> done = task.get_future();
    {
        std::lock_guard lock(mutex_);
        tasks_.push(std::move(task));
    }
    wake_.notify_one();
    done.wait();
    for (const DeferredLog::Message &message : messages)
        message.log(message.level, message.text);
    done.get();
}

void GlThread::serve(std::promise<void> started)
try {
    EglContext context;
    started.set_value();
    for (;;) {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return ending_ || !tasks_.empty(); });
        if (tasks_.empty())
            return;
        Task task = std::move(tasks_.front());
        tasks_.pop();
        lock.unlock();
        task();
    }
} catch (...) {
    started.set_exception(std::current_exception());  // only making the context throws: tasks keep theirs
}

}  // namespace brume::gl
