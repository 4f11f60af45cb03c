// The messages of a run written as files for ParaView while it runs: particles_NNNN.vtp for each particle cloud,
// body_<name>_NNNN.vtp for each rigid body where it was then, cracks_NNNN.vtp for the faces of all cracks, and run.pvd,
// which names them all with their times. Open that one.
//
// Over several ranks each writes its own particles, to particles_NNNN_<rank>.vtp; particles_NNNN.pvtp names these
// pieces, and run.pvd it. The first rank writes that, and all else. A folder that not all of them see has no use.
#pragma once

#include <fstream>
#include <map>
#include <string>

#include "mpm/ranks/communicator.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/message_sink.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/record/vtk_file.hpp"

namespace mpm_ros {

class VtkSink : public MessageSink {
 public:
  /// Makes the folder. `ranks`: null for a process that is alone. @throws VtkError
  VtkSink(const std::string& folder, const Stamps& stamps, mpm::Communicator* ranks = nullptr);
  /// @throws VtkError when run.pvd could not be written.
  void close();

  bool wants(const std::string& topic) const override;
  bool takes_own_particles() const override { return ranks_ != nullptr; }
  // Each @throws VtkError when it cannot be written; that of a cloud on all ranks, with one reason.
  void put(const std::string& topic, const ros::Time& stamp, const visualization_msgs::MarkerArray& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Cracks& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) override;

 private:
  bool first() const { return mpm::is_first(ranks_); }
  void write_piece(const VtkFile& file) const;
  /// Writes the file that names all pieces.
  void write_whole(const VtkFile& file, double time);
  void write_bodies(double time);
  void write_cracks(double time);
  /// Writes the file, and names it in run.pvd, which is whole after each.
  void write(const VtkFile& file, const std::string& stem, int part, double time);
  void list(const std::string& stem, const std::string& name, int part, double time);

  std::string folder_;
  Stamps stamps_;
  mpm::Communicator* ranks_;
  std::ofstream list_;                        ///< run.pvd, of the first rank
  int count_ = 0;                             ///< number of clouds
  std::map<std::string, mpm::Vec3> origins_;  ///< origins of frames but the world's: then all is in double precision
  visualization_msgs::MarkerArray shapes_;
  BodyStates bodies_;  ///< as they were last
  Cracks cracks_;      ///< as they were last
};

}  // namespace mpm_ros
