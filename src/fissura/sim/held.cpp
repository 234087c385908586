#include "fissura/sim/held.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

namespace fissura::sim {

using model::Model;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct Body {
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  std::string group;
  bool is_prescribed = false;

  Vec3 centre() const { return 0.5 * (low + high); }
  double longest() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

/// Rigid motions that no support and no prescribed motion concerns.
struct FreeMotions {
  std::array<bool, 3> moves{};
  int turns = -1; ///< axis of a free rotation, or -1
};

class Bodies {
 public:
  explicit Bodies(Model const& model) : m(model), of_tet(mesh::connected_bodies(m.mesh, m.adjacency)) {
    if (of_tet.empty()) return;
    bodies.resize(static_cast<std::size_t>(*std::max_element(of_tet.begin(), of_tet.end())) + 1);
    for (std::size_t t = 0; t < of_tet.size(); ++t) {
      auto& body = bodies[static_cast<std::size_t>(of_tet[t])];
      if (body.group.empty())
        body.group = m.mesh.volume_groups[static_cast<std::size_t>(m.mesh.tet_group[t])];
      for (Vec3 const x : mesh::corners(m.mesh, static_cast<int>(t)))
        for (int k = 0; k < 3; ++k)
          body.low[k] = std::min(body.low[k], x[k]), body.high[k] = std::max(body.high[k], x[k]);
    }
    for (auto const& p : m.prescribed)
      for (int const node : p.nodes) bodies[of_node(node)].is_prescribed = true;
  }

  std::vector<std::string> doubts(bool may_move) const {
    std::vector<std::string> found;
    if (bodies.size() == 1) {
      if (!may_move) say_free(0, "the body", found);
      return found;
    }
    auto const group = linked();
    std::vector<std::size_t> loose;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      bool const alone = std::count(group.begin(), group.end(), group[b]) == 1;
      bool held = false;
      for (std::size_t other = 0; other < bodies.size(); ++other)
        held |= group[other] == group[b] && bodies[other].is_prescribed;
      if (!held && !(m.prescribed.empty() && !m.source.impactors.empty()))
        loose.push_back(b);
      else if (alone && held && !may_move)
        say_free(b, fmt::format("the body {}", name(b)), found);
    }
    say_loose(loose, found);
    return found;
  }

 private:
  std::size_t of_node(int node) const {
    return static_cast<std::size_t>(of_tet[static_cast<std::size_t>(node / 4)]);
  }
  std::string name(std::size_t b) const {
    Vec3 const at = bodies[b].centre();
    return fmt::format("of group `{}` around ({:.4g}, {:.4g}, {:.4g}) m", bodies[b].group, at.x, at.y, at.z);
  }

  /// Bodies that a bar joins, or that touch by their boxes and may so hold each other, have the same number.
  std::vector<std::size_t> linked() const {
    std::vector<std::size_t> group(bodies.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    auto const root = [&](std::size_t b) {
      while (group[b] != b) b = group[b] = group[group[b]];
      return b;
    };
    for (auto const& joint : m.bars.joints)
      group[root(static_cast<std::size_t>(of_tet[static_cast<std::size_t>(joint.tet_a)]))] =
          root(static_cast<std::size_t>(of_tet[static_cast<std::size_t>(joint.tet_b)]));
    if (m.source.contact.on) link_those_that_touch(group, root);
    for (std::size_t b = 0; b < group.size(); ++b) group[b] = root(b);
    return group;
  }

  template <class Root> void link_those_that_touch(std::vector<std::size_t>& group, Root root) const {
    std::vector<std::size_t> by_x(bodies.size());
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    std::sort(by_x.begin(), by_x.end(),
              [&](std::size_t a, std::size_t b) { return bodies[a].low.x < bodies[b].low.x; });
    for (std::size_t i = 0; i < by_x.size(); ++i)
      for (std::size_t j = i + 1; j < by_x.size(); ++j) {
        auto const &a = bodies[by_x[i]], &b = bodies[by_x[j]];
        double const reach = 0.01 * std::min(a.longest(), b.longest());
        if (b.low.x > a.high.x + 0.01 * a.longest()) break;
        bool touch = true;
        for (int k = 0; k < 3; ++k) touch &= a.low[k] <= b.high[k] + reach && b.low[k] <= a.high[k] + reach;
        if (touch) group[root(by_x[i])] = root(by_x[j]);
      }
  }

  void say_loose(std::vector<std::size_t> const& loose, std::vector<std::string>& found) const {
    constexpr std::size_t shown = 5;
    for (std::size_t i = 0; i < std::min(loose.size(), shown); ++i)
      found.push_back(
          fmt::format("nothing holds the body {}: no [[support]] or [[motion]] concerns it, and it "
                      "touches none that is held: any force there carries it off",
                      name(loose[i])));
    if (loose.size() > shown)
      found.push_back(fmt::format("and {} more bodies that nothing holds", loose.size() - shown));
  }

  void say_free(std::size_t b, std::string const& who, std::vector<std::string>& found) const {
    auto const free = free_motions(b);
    for (int k = 0; k < 3; ++k)
      if (free.moves[static_cast<std::size_t>(k)])
        found.push_back(fmt::format("nothing holds {1} along {0}: any force there carries it off; add a "
                                    "[[support]] with fix = [\"{0}\"]",
                                    "xyz"[k], who));
    if (free.turns >= 0)
      found.push_back(
          fmt::format("nothing keeps {} from turning about an axis along {}: add a [[support]] away "
                      "from that axis",
                      who, "xyz"[free.turns]));
  }

  /// The null space of the sum of squares of what supports and prescribed motions concern.
  FreeMotions free_motions(std::size_t b) const {
    auto const& body = bodies[b];
    Vec3 const centre = body.centre();
    Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
    for (auto const& p : m.prescribed) {
      Eigen::Matrix<double, 6, 6> mine = Eigen::Matrix<double, 6, 6>::Zero();
      long count = 0;
      for (int const node : p.nodes) {
        if (of_node(node) != b) continue;
        ++count;
        Vec3 const x = (2 / body.longest()) * (m.position.at(static_cast<std::size_t>(node)) - centre);
        Eigen::Matrix<double, 6, 1> row = Eigen::Matrix<double, 6, 1>::Zero();
        row[p.axis] =
            1; // displacement along the axis of a unit translation, and of unit rotations: (w x r).e
        int const next = (p.axis + 1) % 3, last = (p.axis + 2) % 3;
        row[3 + next] = x[last], row[3 + last] = -x[next];
        mine += row * row.transpose();
      }
      if (count > 0) sum += mine / static_cast<double>(count);
    }
    FreeMotions free;
    for (int k = 0; k < 3; ++k) free.moves[static_cast<std::size_t>(k)] = sum.row(k).norm() < 1e-9;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> const modes(sum);
    for (int i = 0; i < 6; ++i) {
      if (modes.eigenvalues()[i] > 1e-9) continue;
      Eigen::Vector3d turn = modes.eigenvectors().col(i).tail<3>();
      if (turn.norm() > 1e-3) turn.cwiseAbs().maxCoeff(&free.turns);
    }
    return free;
  }

  Model const& m;
  std::vector<int> of_tet;
  std::vector<Body> bodies;
};

} // namespace

std::vector<std::string> held_doubts(Model const& m, bool may_move) {
  return Bodies(m).doubts(may_move);
}

} // namespace fissura::sim
