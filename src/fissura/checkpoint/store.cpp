#include "fissura/checkpoint/store.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/core.h>
#include <vector>

#include "fissura/checkpoint/file.hpp"
#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::checkpoint {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = "checkpoint_", ending = ".bin";
constexpr std::size_t kept = 2;

/// The number of checkpoint_00012.bin; 0 for other names.
long number_of(std::string const& name) {
  if (name.size() <= prefix.size() + ending.size() || !name.starts_with(prefix) || !name.ends_with(ending))
    return 0;
  char const *from = name.data() + prefix.size(), *to = name.data() + name.size() - ending.size();
  long number = 0;
  auto const [end, error] = std::from_chars(from, to, number);
  return error == std::errc() && end == to && number > 0 ? number : 0;
}

/// Ascending.
std::vector<long> numbers_in(std::string const& folder) {
  std::vector<long> numbers;
  std::error_code ec;
  for (auto const& entry : fs::directory_iterator(folder, ec))
    if (long const n = number_of(entry.path().filename().string()); n > 0) numbers.push_back(n);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string path_in(std::string const& folder, long number) {
  return fmt::format("{}/{}{:05}{}", folder, prefix, number, ending);
}

void remove_file(fs::path const& path) {
  std::error_code ec;
  fs::remove(path, ec);
  if (ec)
    throw core::Error(core::Failure::io, fmt::format("cannot remove '{}': {}", path.string(), ec.message()));
}

} // namespace

Store::Store(std::string const& run_folder) : folder_(run_folder + "/checkpoints") {
  std::error_code ec;
  fs::create_directories(folder_, ec);
  if (ec)
    throw core::Error(core::Failure::io,
                      fmt::format("{}: cannot create the folder: {}", folder_, ec.message()));
  auto const numbers = numbers_in(folder_);
  if (!numbers.empty()) last_ = numbers.back();
}

std::string Store::path_of(long number) const {
  return path_in(folder_, number);
}

std::string Store::write(std::function<void(Saver&)> const& contents) {
  std::string const path = path_of(last_ + 1);
  write_file(path, contents);
  ++last_;
  auto const numbers = numbers_in(folder_);
  for (std::size_t i = 0; i + kept < numbers.size(); ++i) remove_file(path_of(numbers[i]));
  return path;
}

std::string Store::last() const {
  return last_ > 0 ? path_of(last_) : "";
}

void Store::adopt(std::string const& path) {
  std::string const contents = read_file(path);
  write_file(path_of(++last_), [&](Saver& save) { save.bytes(contents); });
}

void Store::cut_back_to(std::string const& path) {
  long const number = number_of(fs::path(path).filename().string());
  for (long const n : numbers_in(folder_))
    if (n > number) remove_file(path_of(n));
  std::vector<fs::path> half_written;
  std::error_code ec;
  for (auto const& entry : fs::directory_iterator(folder_, ec))
    if (entry.path().extension() == ".part") half_written.push_back(entry.path());
  for (auto const& part : half_written) remove_file(part);
  output::flush_folder(folder_);
  last_ = number;
}

std::string find(std::string const& place) {
  std::error_code ec;
  if (fs::is_regular_file(place, ec)) return place;
  if (!fs::is_directory(place, ec))
    throw core::InputError({place}, "there is neither a checkpoint nor a run folder of this name");
  auto const numbers = numbers_in(place + "/checkpoints");
  if (numbers.empty()) throw core::InputError({place}, "there is no checkpoint in this run folder");
  return path_in(place + "/checkpoints", numbers.back());
}

std::string run_folder_of(std::string const& path) {
  fs::path const folder = fs::absolute(path).lexically_normal().parent_path();
  if (folder.filename() != "checkpoints" || number_of(fs::path(path).filename().string()) == 0)
    throw core::InputError(
        {path}, "a checkpoint is read from where it was written, RUN/checkpoints/checkpoint_NUMBER.bin: the "
                "files of the run that it goes on with lie there");
  return folder.parent_path().string();
}

} // namespace fissura::checkpoint
