// Transfers between the particles of a velocity field and its nodes, for a physics beside the mechanics: with them a
// field such as temperature, colour or volume needs no kernels of its own. With the run's shape function S_ip of node i
// and particle p, its gradient G_ip [1/m] and, about an axis, the hoop function T_ip [1/m], the transfers are:
//
//   gather                number of a particle  =  sum over i of S_ip number_i
//   gradient              vector of a particle  =  sum over i of G_ip number_i
//   slopes                vector of a particle  =  sum over i of G_ip,k vector_i,k, for each axis k
//   spread                number of a node      =  sum over p of S_ip number_p, or of m_p S_ip number_p
//   spread_gradient       number of a node      =  sum over p of G_ip . vector_p
//   spread_gradient_sum   vector of a node      =  sum over p of G_ip number_p
//   diffuse               number of a node      =  - sum over p of m_p conducts_p G_ip . (sum over j of G_jp number_j)
//
// Functions are those of the particles' present positions. Domains that follow the deformation are those of the last
// gathering of momentum, as in the rest of a step; so a stage calls these after momentum has been gathered and before
// particles move. About an axis values have the weight r where the run's functions do (shape/axis_rules.hpp).
//
// Particles' numbers are double in either precision of the run; they are rounded to that precision in the transfer, as
// velocities are. Sums over particles are grouped like those of the mechanics: the same bits for any number of threads.
// Source: method reference 2, 3, 8.1.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

class ScalarTransfer {
 public:
  /// [set][component]: an array of one number a particle, in the set's order. A set whose first array is null takes no
  /// part. Components are along the grid's axes (r, z about an axis); about an axis component 2 belongs to the hoop
  /// direction, and may be null where it is not wanted.
  using Given = std::vector<std::array<const double*, 3>>;
  using Taken = std::vector<std::array<double*, 3>>;
  /// One mark for each block of the velocity field; not 0: marked.
  using Marks = std::vector<std::uint8_t>;
  enum class Weight { one, mass };

  virtual ~ScalarTransfer() = default;

  /// Gathers `from` at the particles of velocity field `field`. `from` has one component, or as many as the grid has
  /// axes; as many arrays of `to` are written, for the particles of this velocity field only. Those that choose a field
  /// at every node (grid/node_choice.hpp) gather the sum over their fields: call it for all of these, in ascending
  /// order. With `only`, particles in other blocks are left out unless they choose.
  virtual void gather(int field, const NodalField& from, const Taken& to, const Marks* only = nullptr) = 0;

  /// Gradient of `from`, which has one component: `to` gets d/dx_k, and in the hoop direction the sum of T_ip number_i.
  virtual void gradient(int field, const NodalField& from, const Taken& to, const Marks* only = nullptr) = 0;

  /// `to`[k] = d/dx_k of component k of `from`, which has as many as the grid has axes.
  virtual void slopes(int field, const NodalField& from, const Taken& to) = 0;

  /// Distance from a particle to the place whose slope the gradient takes, along each axis [m]: `to`[k] = sum of
  /// G_ip (x_i^2 / 2) along k, less x_p. Half a cell's width at most, and 0 where G is exact for parabolas. For the
  /// particles of all fields.
  virtual void slope_lead(const Taken& to) = 0;

  /// Sets `to`, of one component or as many as the grid has axes, on all blocks of the velocity field; with `only` on
  /// the marked ones, and its values elsewhere have no meaning.
  virtual void spread(int field, const Given& of, Weight weight, NodalField& to, const Marks* only = nullptr) = 0;

  /// Sets `to`, of one component. If the vectors have a hoop component, T_ip times that is added; without one the sum
  /// is the weak form of a divergence about an axis.
  virtual void spread_gradient(int field, const Given& of, Weight weight, NodalField& to,
                               const Marks* only = nullptr) = 0;

  /// Sets `to`, of as many components as the grid has axes; takes the first number of each particle. Without T_ip.
  virtual void spread_gradient_sum(int field, const Given& of, Weight weight, NodalField& to,
                                   const Marks* only = nullptr) = 0;

  /// Sets `to` to what flows to the nodes down the gradient of `from`, both of one component: gradient() and
  /// spread_gradient() in one pass, with the conductance by mass in the first array of each set. Particles that choose
  /// a field at every node are left out.
  virtual void diffuse(int field, const Given& conducts, const NodalField& from, NodalField& to) = 0;

  /// Adds what these give, after diffuse() of all fields: at each node to the field that they have there, down the
  /// gradient of the values that their nodes have in all of them. `from` and `to`: of each field.
  virtual void diffuse_chosen(const Given& conducts, const std::vector<NodalField>& from,
                              std::vector<NodalField>& to) = 0;

  // Transfers of the particles of one block, by the number of its owner in the field. `around` has the 3^dim blocks
  // around it, itself in the middle, the last axis fastest (take_tile() in step/block_probe.hpp).

  /// spread() of this block.
  virtual void spread_of_block(int field, int owner, const Given& of, Weight weight, NodalField& around) = 0;
  /// spread_gradient() of this block, or spread_gradient_sum() where `around` has more than one component.
  virtual void spread_gradient_of_block(int field, int owner, const Given& of, Weight weight, NodalField& around) = 0;
  /// gradient() at the particles of this block.
  virtual void gradient_of_block(int field, int owner, const NodalField& from, const Taken& to) = 0;
};

}  // namespace mpm
