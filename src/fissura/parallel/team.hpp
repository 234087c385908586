#pragma once
// Threads that share out chunks of work. A step has a dozen short passes, so they wait by spinning, but not
// for long: on a machine with other work to do they yield, and in the end sleep.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace fissura::parallel {

class Team {
 public:
  using Work = void (*)(void const* context, std::size_t chunk);

  /// `threads` includes the one that calls run(). Throws core::Error if the system grants no more of them.
  explicit Team(int threads);
  ~Team();
  Team(Team const&) = delete;
  Team& operator=(Team const&) = delete;

  int size() const { return static_cast<int>(shares_.size()); }

  /// Calls work(context, chunk) for every chunk below `count`. Each thread begins with its own share, always
  /// the same chunks, and then takes what others have left. Throws what `work` throws first. Within `work`,
  /// or while another thread is in run(), all chunks are done by the caller.
  void run(std::size_t count, Work work, void const* context);

 private:
  /// What is left of a thread's share.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  void dismiss();
  void serve(std::size_t me);
  bool join(std::uint64_t& seen);
  void work_through(std::size_t me);

  // generation << 17 | open << 16 | threads at work. Nobody is waited for who has not joined in time.
  static constexpr std::uint64_t open = 1U << 16, one_generation = 1U << 17, at_work = open - 1;
  alignas(64) std::atomic<std::uint64_t> state_{0};
  std::atomic<bool> stop_{false};
  std::vector<Share> shares_;
  Work work_ = nullptr;
  void const* context_ = nullptr;
  std::mutex busy_;
  std::mutex failing_;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

} // namespace fissura::parallel
