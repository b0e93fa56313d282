#include "image/cube.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace spectrad {

namespace {

class ThreadedWriter : public CubeWriter {
  public:
    ThreadedWriter(std::unique_ptr<CubeWriter> writer, size_t maxQueuedBytes, const CubeInfo& info)
        : writer_(std::move(writer)),
          maxQueuedBytes_(maxQueuedBytes),
          bandRow_(info.wavelengths.size() * static_cast<size_t>(info.width)),
          previewRow_(3 * static_cast<size_t>(info.width)),
          thread_([this] { run(); }) {}

    /// Abandons what is queued; the inner writer then leaves nothing behind.
    ~ThreadedWriter() override {
        {
            const std::lock_guard lock(mutex_);
            queue_.clear();
            closed_ = true;
        }
        changed_.notify_all();
        if (thread_.joinable()) thread_.join();
    }

    void write(int rows, const float* bands, const float* previewRgb) override {
        if (rows <= 0) return;
        const size_t count = static_cast<size_t>(rows);
        const size_t bytes = count * (bandRow_ + previewRow_) * sizeof(float);
        {
            std::unique_lock lock(mutex_);
            // A strip larger than the queue may pass alone.
            changed_.wait(
                lock, [&] { return error_ || queuedBytes_ == 0 || queuedBytes_ + bytes <= maxQueuedBytes_; });
            if (error_) std::rethrow_exception(error_);
            queuedBytes_ += bytes;
        }
        Strip strip{rows, bytes, {}, {}};
        strip.bands.assign(bands, bands + count * bandRow_);
        if (previewRgb) strip.preview.assign(previewRgb, previewRgb + count * previewRow_);
        {
            const std::lock_guard lock(mutex_);
            queue_.push_back(std::move(strip));
        }
        changed_.notify_all();
    }

    WriteReport finish() override {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        changed_.notify_all();
        thread_.join();
        if (error_) std::rethrow_exception(error_);
        return writer_->finish();
    }

  private:
    struct Strip {
        int rows;
        size_t bytes;
        std::vector<float> bands, preview;
    };

    void run() {
        while (true) {
            Strip strip;
            {
                std::unique_lock lock(mutex_);
                changed_.wait(lock, [&] { return closed_ || !queue_.empty(); });
                if (queue_.empty()) return;
                strip = std::move(queue_.front());
                queue_.pop_front();
            }
            try {
                writer_->write(strip.rows, strip.bands.data(),
                               strip.preview.empty() ? nullptr : strip.preview.data());
            } catch (...) {
                const std::lock_guard lock(mutex_);
                error_ = std::current_exception();
                queue_.clear();
            }
            {
                // Bytes count until they are written: the strip in hand is memory as well.
                const std::lock_guard lock(mutex_);
                queuedBytes_ -= strip.bytes;
                if (error_) return changed_.notify_all();
            }
            changed_.notify_all();
        }
    }

    std::unique_ptr<CubeWriter> writer_;
    const size_t maxQueuedBytes_, bandRow_, previewRow_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Strip> queue_;
    size_t queuedBytes_ = 0;
    bool closed_ = false;
    std::exception_ptr error_;
    std::thread thread_;  // last: it starts when all else is there
};

}  // namespace

std::unique_ptr<CubeWriter> onOwnThread(std::unique_ptr<CubeWriter> writer, size_t maxQueuedBytes,
                                        const CubeInfo& info) {
    return std::make_unique<ThreadedWriter>(std::move(writer), maxQueuedBytes, info);
}

}  // namespace spectrad
