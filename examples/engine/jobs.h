/// The engine's job system: a few threads and a list of tasks. The library runs all its loops and
/// jobs in it and starts no thread of its own.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace engine {

class Jobs {
  public:
    struct Task {
        std::function<void()> work;
        bool done = false;
    };

    explicit Jobs(unsigned threads) {
        for (unsigned i = 0; i < threads; ++i) workers_.emplace_back([this] { work(); });
    }
    ~Jobs() {
        {
            const std::lock_guard lock(mutex_);
            closing_ = true;
        }
        changed_.notify_all();
        for (std::thread& worker : workers_) worker.join();
    }

    std::shared_ptr<Task> begin(std::function<void()> work) {
        auto task = std::make_shared<Task>(Task{std::move(work)});
        {
            const std::lock_guard lock(mutex_);
            waiting_.push_back(task);
        }
        changed_.notify_all();
        return task;
    }

    /// Works on other tasks while this one is not done, so that tasks may wait for tasks.
    void wait(const Task& task) {
        std::unique_lock lock(mutex_);
        while (!task.done) {
            if (!run_one(lock)) changed_.wait(lock);
        }
    }

    /// Calls `chunk` for each number below `count`, on all threads and this one.
    void parallel_for(std::size_t count, const std::function<void(std::size_t)>& chunk) {
        std::vector<std::shared_ptr<Task>> tasks;
        for (std::size_t i = 1; i < count; ++i) tasks.push_back(begin([&chunk, i] { chunk(i); }));
        if (count > 0) chunk(0);
        for (const auto& task : tasks) wait(*task);
    }

    /// Tasks that were done so far.
    std::size_t count() const { return count_; }

  private:
    // Runs a waiting task, without the lock; returns false if there is none.
    bool run_one(std::unique_lock<std::mutex>& lock) {
        if (waiting_.empty()) return false;
        const std::shared_ptr<Task> task = waiting_.front();
        waiting_.pop_front();
        lock.unlock();
        task->work();
        lock.lock();
        task->done = true;
        ++count_;
        changed_.notify_all();
        return true;
    }
    void work() {
        std::unique_lock lock(mutex_);
        while (!closing_) {
            if (!run_one(lock)) changed_.wait(lock);
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::shared_ptr<Task>> waiting_;
    std::size_t count_ = 0;
    bool closing_ = false;
    std::vector<std::thread> workers_;
};

}  // namespace engine
