#pragma once
// The largest eigenvalue of a symmetric operator that is known only by its products with vectors.
#include <functional>
#include <span>
#include <vector>

namespace fissura::step {

/// out = A in - share out; both have the size of the start vector. Single precision: two vectors are all that
/// the search needs in memory, and the eigenvalue is wanted to a thousandth.
using Product = std::function<void(std::span<float const> in, double share, std::span<float> out)>;

/// Largest eigenvalue of A, up to `tolerance` of it: the Lanczos value plus its residual. Stops after
/// `most_steps` products. `start` must be in the space on which A acts.
double largest_eigenvalue(Product const& product, std::vector<float> start, double tolerance, int most_steps);

} // namespace fissura::step
