// Sources that feed or drain a transported quantity at nodes: flux through faces, contact with tools and other bodies,
// friction. Each books what it gave under its own name.
#pragma once

#include <string>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// Content that came in since the start, under one name.
struct ContentAccount {
  std::string name;
  double given = 0.0;      ///< [content]
  double exchanged = 0.0;  ///< sum of |given| over updates
  void add(double content) {
    given += content;
    exchanged += content < 0.0 ? -content : content;
  }
};

/// The quantity on the nodes as an update begins, and what flows to them.
struct NodalQuantity {
  NodalField value;     ///< T_i
  NodalField capacity;  ///< c_i [content/quantity]
  NodalField source;    ///< [content/s]
};

class NodalSource {
 public:
  virtual ~NodalSource() = default;
  /// Adds to `source` what flows in during `dt`, and books it. `start` [s]: of the update.
  virtual void give(std::vector<NodalQuantity>& nodes, double start, double dt) = 0;
  virtual void accounts(std::vector<ContentAccount>& list) const = 0;
  /// Largest dQ/dT by area, of what depends on the quantity at the node, up to this value of it; 0: none.
  virtual double conductance(double /*most*/) const { return 0.0; }
  /// True if it may feed particles of a block at rest, which then has to be awake.
  virtual bool feeds(const RestingBlock& /*block*/) const { return false; }
  /// True if an update must not wait.
  virtual bool pending() const { return false; }
  virtual void serialise(StateArchive& archive) = 0;
};

}  // namespace mpm
