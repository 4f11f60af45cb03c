// Copies of the nodes of some blocks, and of some particles, between the device and the host. On the host nodal numbers
// lie as in mpm/grid/nodal_fields.hpp, [block][component][node].
//
// When velocities come back from contact, walls hold their nodes again (mpm/step/order.hpp): frictional ones, which
// have not acted at these nodes before, then those that always hold.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <class T>
class NearCopies {
 public:
  /// `walls_again`: whether walls hold nodes whose velocities come back.
  NearCopies(int dim, bool walls_again) : dim_(dim), walls_again_(walls_again), per_block_(nodes_of_block(dim)) {}

  /// Keys of all blocks of the table.
  void download_keys(Executor& run, const NodeView& nodes, std::vector<std::uint64_t>& keys);
  /// First particles, and then those past the last, of the nodes of some blocks: [set][block][node] of each.
  void download_ranges(Executor& run, const Step<T>& step, const std::vector<std::int32_t>& blocks,
                       std::vector<std::uint32_t>& ranges);

  /// Takes these blocks from here on, by their numbers in the table. `mark`: whether to mark their nodes, for walls.
  void take_blocks(Executor& run, const NodeView& nodes, const std::vector<std::int32_t>& blocks, bool mark);
  /// [node] 1 where it is marked; null if none is.
  const std::uint8_t* marks() const { return marks_.data(); }
  /// Takes these particles, by their numbers, and copies their ids to the host, and their `surface` where there is one.
  void take_particles(Executor& run, const Step<T>& step, const std::vector<std::uint32_t>& particles,
                      std::vector<std::uint32_t>& ids, std::vector<double>& surface);

  /// Copies `components` of each node to the host.
  void download(Executor& run, const NodeView& nodes, const double* from, int components, double* to);
  /// The same, which are there after the next copy that is waited for.
  void download_soon(Executor& run, const NodeView& nodes, const double* from, int components, double* to);
  /// Copies places, velocities and `components` of the deformation gradient: [component][particle].
  void download_particles(Executor& run, const Step<T>& step, int components, std::vector<double>& to);
  /// Takes places as download_particles() gave them, [axis][particle].
  void upload_places(Executor& run, const Step<T>& step, const std::vector<double>& from);

  /// Takes velocities for the strain.
  void upload_for_strain(Executor& run, const Step<T>& step, const double* velocity);
  /// Takes velocities and accelerations of the step's end, which walls change in the time of the step.
  void upload_at_end(Executor& run, const Step<T>& step, const double* velocity, const double* acceleration);
  /// Takes velocities of which increments will be found.
  void upload_first_increment(Executor& run, const Step<T>& step, const double* increment);
  /// Takes increments in place of those that the nodes' velocities have.
  void upload_increment(Executor& run, const Step<T>& step, const double* increment);

 private:
  long count() const { return blocks_ * per_block_; }
  /// Lays what is to be copied into the room.
  void gather(Executor& run, const NodeView& nodes, const double* from, int components);
  void upload(Buffer<double>& room, const double* from);
  /// kernel(node, place of its component 0 in an upload, distance from one component to the next) for each node.
  template <class Kernel>
  void each_node(Executor& run, const Kernel& kernel);
  /// kernel(node, its number along each axis, what came back, place of component 0) for each node.
  template <int Dim, class Kernel>
  void each_returned(Executor& run, const Step<T>& step, const Kernel& kernel);
  template <int Dim>
  void take_for_strain(Executor& run, const Step<T>& step);
  template <int Dim>
  void take_at_end(Executor& run, const Step<T>& step);
  template <int Dim>
  void take_first_increment(Executor& run, const Step<T>& step);
  template <int Dim>
  void take_increment(Executor& run, const Step<T>& step);

  int dim_;
  bool walls_again_;
  long per_block_, blocks_ = 0, particles_ = 0;
  Buffer<std::int32_t> block_;      ///< numbers in the table
  Buffer<std::uint32_t> particle_;  ///< numbers of the particles
  Buffer<std::uint8_t> marks_;
  Buffer<double> room_, other_room_;
  Buffer<std::uint32_t> whole_room_;
  Buffer<std::uint64_t> key_room_;
};

}  // namespace mpm_gpu
