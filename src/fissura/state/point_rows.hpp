#pragma once
// What the point pass knows of each cluster now: derived from Model::points and the joints that still hold.
#include <cstdint>
#include <vector>

namespace fissura::state {

struct PointRows {
  /// Of a cluster of mass m: what every step reads. mu: its inertia relative to its point.
  struct Row {
    double inverse = 0; ///< 1/(m + mu)
    double beta = 0;    ///< mu/(m + mu)
    double mu = 0;      ///< [kg]
    double inertia = 0; ///< m + mu [kg]
  };
  std::vector<Row> row;
  std::vector<double> mass;          ///< per cluster: m [kg]
  std::vector<double> weight;        ///< per cluster: the real mass, what gravity acts on [kg]
  std::vector<double> per_pull;      ///< per point in one part: 1/sum(beta mass); 0 with one cluster
  std::vector<double> per_mu;        ///< per point in one part: 1/sum(mu)
  std::vector<std::uint8_t> parts;   ///< per point: how many parts its released joints have left
  std::vector<std::uint8_t> part;    ///< per cluster: which one
  std::vector<int> released;         ///< per group of joints: how many of them have been taken notice of
  std::vector<int> touched;          ///< points to renew
  std::vector<double> part_reaction; ///< per chunk of points and Model::prescribed [N]
  std::vector<double> reaction;      ///< per Model::prescribed: their sum
};

} // namespace fissura::state
