#include "gl/gl_thread.h"

#include <utility>
#include <vector>

#include "base/log.h"
#include "gl/egl_context.h"

namespace brume::gl {

GlThread::GlThread() : thread_(&GlThread::serve, this)
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready_; });
    if (!failure_)
        return;
    lock.unlock();
    thread_.join();
    std::rethrow_exception(failure_);
}

GlThread::~GlThread()
{
    {
        std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void GlThread::invoke(const std::function<void()> &work)
{
    if (std::this_thread::get_id() == thread_.get_id())
        return work();
    std::vector<DeferredLog::Message> messages;
    const std::function<void()> logged = [&] {
        DeferredLog log;
        try {
            work();
        } catch (...) {
            messages = log.take();
            throw;
        }
        messages = log.take();
    };
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !work_; });
    work_ = &logged;
    ready_ = false;
    changed_.notify_all();
    changed_.wait(lock, [&] { return ready_; });
    const std::exception_ptr failure = std::exchange(failure_, nullptr);
    work_ = nullptr;
    lock.unlock();
    changed_.notify_all();
    for (const DeferredLog::Message &message : messages)
        message.log(message.level, message.text);
    if (failure)
        std::rethrow_exception(failure);
}

void GlThread::serve()
{
    std::unique_lock lock(mutex_);
    try {
        EglContext context;
        ready_ = true;
        changed_.notify_all();
        for (;;) {
            changed_.wait(lock, [&] { return ending_ || (work_ && !ready_); });
            if (!work_ || ready_)
                return;
            lock.unlock();
            std::exception_ptr failure;
            try {
                (*work_)();
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            failure_ = failure;
            ready_ = true;
            changed_.notify_all();
        }
    } catch (...) {
        failure_ = std::current_exception();  // of making the context: what callers run keeps its own
        ready_ = true;
        changed_.notify_all();
    }
}

}  // namespace brume::gl
