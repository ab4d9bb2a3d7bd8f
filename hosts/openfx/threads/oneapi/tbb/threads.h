// Stands in for what the CPU backend uses of oneTBB. A host may have loaded a TBB of another version for everyone, and TBB's
// workers may still run when a plugin is unloaded; these threads are nobody else's and end with their arena.
#pragma once
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace oneapi::tbb {

namespace info {
inline int default_concurrency()
{
    return int(std::max(1u, std::thread::hardware_concurrency()));
}
}  // namespace info

class task_arena {
public:
    explicit task_arena(int threads) : threads_(threads) {}

    ~task_arena()
    {
        {
            std::lock_guard lock(mutex_);
            ending_ = true;
        }
        wake_.notify_all();
        for (std::thread &worker : workers_)
            worker.join();
    }

    template <class Function> void execute(Function function)
    {
        struct Restore {
            task_arena *outer;
            ~Restore() { current_ = outer; }
        } restore{std::exchange(current_, this)};
        function();
    }

    // What throws ends the loop, and is thrown here when all threads have left it.
    static void run(int count, const std::function<void(int)> &function)
    {
        if (current_ && current_->threads_ > 1 && count > 1)
            return current_->share(count, function);
        for (int i = 0; i < count; ++i)
            function(i);
    }

private:
    void share(int count, const std::function<void(int)> &function)
    {
        {
            std::lock_guard lock(mutex_);
            while (int(workers_.size()) < threads_ - 1)
                workers_.emplace_back([this] { serve(); });
            function_ = &function;
            count_ = count;
            next_ = 0;
            busy_ = workers_.size();
            ++round_;
        }
        wake_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [&] { return busy_ == 0; });
        if (error_)
            std::rethrow_exception(std::exchange(error_, nullptr));
    }

    void work()
    {
        for (int i; (i = next_++) < count_;)
            try {
                (*function_)(i);
            } catch (...) {
                std::lock_guard lock(mutex_);
                if (!error_)
                    error_ = std::current_exception();
                next_ = count_;
            }
    }

    void serve()
    {
        std::unique_lock lock(mutex_);
        for (unsigned long served = 0;;) {
            wake_.wait(lock, [&] { return ending_ || round_ != served; });
            if (ending_)
                return;
            served = round_;
            lock.unlock();
            work();
            lock.lock();
            if (--busy_ == 0)
                idle_.notify_one();
        }
    }

    static inline thread_local task_arena *current_ = nullptr;
    const int threads_;
    std::mutex mutex_;
    std::condition_variable wake_, idle_;
    std::vector<std::thread> workers_;
    const std::function<void(int)> *function_ = nullptr;
    int count_ = 0;
    std::atomic<int> next_ = 0;
    size_t busy_ = 0;
    unsigned long round_ = 0;
    std::exception_ptr error_;
    bool ending_ = false;
};

template <class Value> class blocked_range {
public:
    blocked_range(Value begin, Value end, Value grain) : begin_(begin), end_(end), grain_(grain) {}
    Value begin() const { return begin_; }
    Value end() const { return end_; }
    Value grain() const { return grain_; }

private:
    Value begin_, end_, grain_;
};

template <class Function> void parallel_for(int begin, int end, const Function &function)
{
    task_arena::run(end - begin, [&](int i) { function(begin + i); });
}

template <class Function> void parallel_for(const blocked_range<int> &range, const Function &function)
{
    const int length = range.end() - range.begin(), parts = (length + range.grain() - 1) / range.grain();
    task_arena::run(parts, [&](int i) {
        const int from = range.begin() + i * range.grain();
        function(blocked_range<int>(from, std::min(from + range.grain(), range.end()), range.grain()));
    });
}

}  // namespace oneapi::tbb
