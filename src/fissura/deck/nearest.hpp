#pragma once
// "did you mean": the known word nearest to a mistyped one.
#include <string>
#include <string_view>
#include <vector>

namespace fissura::deck {

/// The nearest of `known` within about a third of the word's letters; empty if none is near. Insertion,
/// deletion, replacement and exchange of neighbours count one each; capitals and `-` for `_` count nothing.
std::string_view nearest(std::string_view word, std::vector<std::string_view> const& known);

/// "; did you mean `x`?" or nothing.
std::string did_you_mean(std::string_view word, std::vector<std::string_view> const& known);

/// "`a`, `b` or `c`".
std::string listed(std::vector<std::string_view> const& words);

} // namespace fissura::deck
