#pragma once
// A fixed-size array for the hot data of the step: zeroed, aligned to cache lines, and lazily committed by
// the kernel, so histories of joints that never crack take no memory. Packs may read a line beyond the end.
// Successive buffers start at different
// offsets within a page: arrays whose starts agree modulo 4096 slow each other down (cache aliasing).
#include <sys/mman.h>

#include <atomic>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace fissura::core {

template <class T> class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  explicit Buffer(std::size_t size) : size_(size) {
    static std::atomic<unsigned> serial{0};
    std::size_t const offset = (serial.fetch_add(1) % 61) * 64; // odd number of lines apart, below one page
    bytes_ = size * sizeof(T) + offset + 64;
    void* const p = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) throw std::bad_alloc();
    base_ = p;
    data_ = reinterpret_cast<T*>(static_cast<char*>(p) + offset);
  }
  Buffer(Buffer&& b) noexcept { swap(b); }
  Buffer& operator=(Buffer&& b) noexcept {
    swap(b);
    return *this;
  }
  Buffer(Buffer const&) = delete;
  Buffer& operator=(Buffer const&) = delete;
  ~Buffer() {
    if (base_) ::munmap(base_, bytes_);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  T const* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  T const& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  T const* begin() const { return data_; }
  T const* end() const { return data_ + size_; }
  std::span<T> span() { return {data_, size_}; }
  std::span<T const> span() const { return {data_, size_}; }

 private:
  void swap(Buffer& b) noexcept {
    std::swap(base_, b.base_);
    std::swap(data_, b.data_);
    std::swap(size_, b.size_);
    std::swap(bytes_, b.bytes_);
  }
  void* base_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0, bytes_ = 0;
};

} // namespace fissura::core
