#pragma once
/// Counts the bytes that the parts of a job hold, against one limit for all of them. Whoever can wait waits
/// until what it is about to take has room; what is there is counted whether it has room or not. Safe from
/// several threads.

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <utility>

namespace acentric {

class MemoryBudget {
 public:
  static constexpr std::size_t kUsual = std::size_t(1536) << 20;

  explicit MemoryBudget(std::size_t limit = kUsual) : limit_(limit) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  /// Bytes that are counted as long as it lives. Of one thread at a time; the budget outlives it.
  class Share {
   public:
    Share() = default;
    explicit Share(MemoryBudget& budget) : budget_(&budget) {}
    Share(Share&& other) noexcept
        : budget_(std::exchange(other.budget_, nullptr)),
          bytes_(std::exchange(other.bytes_, 0)),
          passing_(std::exchange(other.passing_, false)) {}
    Share& operator=(Share&& other) noexcept;
    ~Share() { release(); }

    void set(std::size_t bytes);
    /// Waits until its growth has room, or nothing is left that goes by itself, and takes it before anybody
    /// else can. False, and as it was, when stopped.
    bool setWhenRoom(std::size_t bytes, const std::stop_token& stop);
    void add(std::size_t bytes) { set(bytes_ + bytes); }
    /// From now on it goes by itself, without any work of those that wait: they may wait for it.
    void pass();
    std::size_t bytes() const { return bytes_; }

   private:
    void release();

    MemoryBudget* budget_ = nullptr;
    std::size_t bytes_ = 0;
    bool passing_ = false;
  };

  std::size_t limit() const { return limit_; }
  std::size_t held() const;
  std::size_t peak() const;  ///< the most that was held

 private:
  void change(std::size_t before, std::size_t after, int passing);
  bool growWhenRoom(std::size_t before, std::size_t after, const std::stop_token& stop);

  std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable_any less_;
  std::size_t held_ = 0, peak_ = 0;
  int passing_ = 0;  ///< shares that go by themselves
};

}  // namespace acentric
