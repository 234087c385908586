#pragma once
// The largest eigenvalue of a symmetric operator that is known only by its products with vectors.
#include <functional>
#include <span>
#include <vector>

namespace fissura::step {

/// out = A in; both have the size of the start vector.
using Product = std::function<void(std::span<double const> in, std::span<double> out)>;

/// Largest eigenvalue of A, up to `tolerance` of it: the Lanczos value plus its residual. Stops after
/// `most_steps` products. `start` must be in the space on which A acts.
double largest_eigenvalue(Product const& product, std::vector<double> start, double tolerance,
                          int most_steps);

} // namespace fissura::step
