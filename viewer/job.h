// Work beside the frames: a thread of its own, with what it was given by value, and a result to be fetched.
#pragma once

#include "base/stopped.h"
#include "base/stopwatch.h"

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace spectrad::view {

/// One piece of work at a time. All calls come from the thread that owns it; only `Work` runs elsewhere.
template <typename Result>
class Job {
  public:
    /// Ends with Stopped (base/stopped.h) soon after it is asked to stop.
    using Work = std::function<Result(const std::stop_token&)>;

    Job() = default;
    ~Job() { stop(); }  // and the thread is joined
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// From start() until its result is taken.
    [[nodiscard]] bool running() const { return result_.valid(); }
    [[nodiscard]] bool done() const { return waited(0); }
    /// Waits for up to `seconds` for the result to be there; true if it is.
    [[nodiscard]] bool waited(double seconds) const {
        return running() &&
               result_.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
    }
    /// How long it has been at work, s.
    [[nodiscard]] double seconds() const { return running() ? clock_.seconds() : 0; }

    /// There must be none running.
    void start(Work work) {
        stop_ = std::stop_source();
        clock_ = Stopwatch();
        std::packaged_task<Result()> task(
            [work = std::move(work), token = stop_.get_token()] { return work(token); });
        result_ = task.get_future();
        thread_ = std::jthread(std::move(task));
    }
    void stop() { stop_.request_stop(); }
    /// Waits. Nothing if the work was stopped; throws what the work threw.
    [[nodiscard]] std::optional<Result> take() {
        std::future<Result> result = std::move(result_);
        try {
            result.wait();
            thread_.join();
            return result.get();
        } catch (const Stopped&) {
            return std::nullopt;
        }
    }

  private:
    std::stop_source stop_;
    std::future<Result> result_;
    Stopwatch clock_;
    std::jthread thread_;
};

}  // namespace spectrad::view
