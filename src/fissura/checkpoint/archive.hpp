#pragma once
// Saver and Loader walk the fields of a struct (fields.hpp) in their order: numbers as they lie in memory
// (little endian), lists with their length before them, and of the histories of joints only those that are
// not all zero, each with its index. A class of the driver describes itself by a static member fields(self).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fissura/checkpoint/fields.hpp"
#include "fissura/core/buffer.hpp"

namespace fissura::checkpoint {

namespace detail {
template <class T> inline constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T> inline constexpr bool is_list = false;
template <class T> inline constexpr bool is_list<std::vector<T>> = true;
template <class T> inline constexpr bool is_buffer = false;
template <class T> inline constexpr bool is_buffer<core::Buffer<T>> = true;
template <class T> inline constexpr bool is_array = false;
template <class T, std::size_t n> inline constexpr bool is_array<std::array<T, n>> = true;
/// Items whose bytes may be copied in one go. (Any other byte than 0 or 1 in a bool would be undefined.)
template <class T> inline constexpr bool is_plain = is_number<T> && !std::is_same_v<T, bool>;

template <class T> auto fields_of(T& x) {
  if constexpr (requires { std::remove_const_t<T>::fields(x); })
    return std::remove_const_t<T>::fields(x);
  else
    return fields(x);
}
template <class Fields> struct LeastSize;
/// Bytes that an item takes in the file, at least.
template <class T> constexpr std::size_t least_size() {
  if constexpr (is_number<T>)
    return std::is_same_v<T, bool> ? 1 : sizeof(T);
  else if constexpr (is_array<T>)
    return std::tuple_size_v<T> * least_size<typename T::value_type>();
  else if constexpr (is_list<T> || is_buffer<T> || std::is_same_v<T, std::string>)
    return 8;
  else
    return LeastSize<decltype(fields_of(std::declval<T&>()))>::value;
}
template <class... T> struct LeastSize<std::tuple<T&...>> {
  static constexpr std::size_t value = (least_size<T>() + ...);
};
} // namespace detail

/// Takes the bytes of a checkpoint.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void write(std::string_view bytes) = 0;
};

class Saver {
 public:
  explicit Saver(Sink& sink) : sink_(sink) {}
  /// Saves its arguments one after the other.
  template <class... T> void operator()(T const&... x) { (save(x), ...); }
  /// As they are.
  void bytes(std::string_view all) { sink_.write(all); }

 private:
  void raw(void const* data, std::size_t size) { sink_.write({static_cast<char const*>(data), size}); }

  template <class T> void save(T const& x) {
    if constexpr (detail::is_number<T>) {
      raw(&x, sizeof x);
    } else if constexpr (std::is_same_v<T, std::string>) {
      save(static_cast<std::uint64_t>(x.size()));
      raw(x.data(), x.size());
    } else if constexpr (detail::is_array<T>) {
      for (auto const& item : x) save(item);
    } else if constexpr (detail::is_list<T>) {
      save(static_cast<std::uint64_t>(x.size()));
      save_items(std::span(x));
    } else if constexpr (detail::is_buffer<T>) {
      save(static_cast<std::uint64_t>(x.size()));
      save_buffer(x.span());
    } else {
      std::apply([&](auto const&... field) { (save(field), ...); }, detail::fields_of(x));
    }
  }
  template <class T> void save_items(std::span<T const> items) {
    if constexpr (detail::is_plain<T>)
      raw(items.data(), items.size_bytes());
    else
      for (auto const& item : items) save(item);
  }
  template <class T> void save_buffer(std::span<T const> items) {
    if constexpr (detail::is_plain<T>)
      save_items(items);
    else
      save_sparse(items);
  }
  template <class T> void save_sparse(std::span<T const> items) {
    std::uint64_t count = 0;
    for (auto const& item : items) count += !is_zero(item);
    save(count);
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!is_zero(items[i])) save(static_cast<std::uint64_t>(i)), save(items[i]);
  }
  /// Whether all bits of all fields are 0; what lies between the fields does not count.
  template <class T> static bool is_zero(T const& x) {
    if constexpr (detail::is_number<T>) {
      static constexpr T zero{};
      return std::memcmp(&x, &zero, sizeof x) == 0;
    } else if constexpr (detail::is_array<T>) {
      return std::all_of(x.begin(), x.end(), [](auto const& item) { return is_zero(item); });
    } else {
      return std::apply([](auto const&... field) { return (is_zero(field) && ...); }, detail::fields_of(x));
    }
  }

  Sink& sink_;
};

/// Reads what a Saver has written, into things of the same shape. Throws core::InputError naming the file
/// where the bytes do not fit: nothing is allocated that the file could not fill.
class Loader {
 public:
  Loader(std::string_view bytes, std::string path) : rest_(bytes), path_(std::move(path)) {}
  template <class... T> void operator()(T&... x) { (load(x), ...); }
  /// Throws unless everything has been read.
  void finish() const;
  [[noreturn]] void refuse(std::string const& reason) const;

 private:
  void raw(void* data, std::size_t size);
  /// A number of items, each of which takes at least one byte more of the file.
  std::size_t count();
  /// The same, for a list that must have `size` items.
  void expect(std::size_t size);

  template <class T> void load(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      raw(&byte, 1);
      if (byte > 1) refuse("a yes or no is neither");
      x = byte == 1;
    } else if constexpr (detail::is_number<T>) {
      raw(&x, sizeof x);
    } else if constexpr (std::is_same_v<T, std::string>) {
      x.resize(count());
      raw(x.data(), x.size());
    } else if constexpr (detail::is_array<T>) {
      for (auto& item : x) load(item);
    } else if constexpr (detail::is_list<T>) {
      if constexpr (grows<typename T::value_type>)
        grow(x, count());
      else
        expect(x.size());
      load_items(std::span(x));
    } else if constexpr (detail::is_buffer<T>) {
      expect(x.size());
      load_buffer(x.span());
    } else {
      std::apply([&](auto&... field) { (load(field), ...); }, detail::fields_of(x));
    }
  }
  template <class T> void grow(std::vector<T>& list, std::size_t size) {
    list.clear();
    if (size > rest_.size() / detail::least_size<T>()) refuse("it ends within a list");
    list.resize(size);
  }
  template <class T> void load_items(std::span<T> items) {
    if constexpr (detail::is_plain<T>)
      raw(items.data(), items.size_bytes());
    else
      for (auto& item : items) load(item);
  }
  template <class T> void load_buffer(std::span<T> items) {
    if constexpr (detail::is_plain<T>)
      load_items(items);
    else
      load_sparse(items);
  }
  template <class T> void load_sparse(std::span<T> items) {
    std::size_t const listed = count();
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < listed; ++i) {
      std::uint64_t index = 0;
      load(index);
      if (index < next || index >= items.size()) refuse("an index is out of its range");
      next = index + 1;
      load(items[index]);
    }
  }

  std::string_view rest_;
  std::string path_;
};

} // namespace fissura::checkpoint
