// Contact between deformable bodies: bodies of different velocity fields that share a node act on each other there by
// the law of their pair, in the frame of their centre of mass.
//
// The data of a node (mass, volume, volume gradient, mean place of each material) are gathered at the step's start, on
// the blocks that fields share and nowhere else. Laws act on v^{n+1}; while strain is updated a pair that was held
// stays held, as step/coulomb.hpp explains; XPIC's increments lose their held components. Impulses come in opposite
// pairs, so nothing is given from outside; only NormalMethod::own has an account, of the sum of its two unequal
// impulses. Bodies that share one velocity ("one_field") are merged before anything else: velocity and acceleration,
// since FLIP takes the acceleration over, which a single field would have; everything after is that single field to
// round-off. Weak: a surface is smeared over two cells; contact begins up to a tenth of a cell early or late
// (pair_detection.hpp), by approach alone a cell early. A node where three bodies meet has a normal for each pair.
// Source: Nairn, GIMP notes 3.2; method reference 8; manual, MultiMaterialMode.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/contact/contact_nodes.hpp"
#include "mpm/contact/contact_reporter.hpp"
#include "mpm/contact/pair_detection.hpp"
#include "mpm/contact/shared_blocks.hpp"
#include "mpm/contact/tool_sides.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/step/stage.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

/// Two bodies and the law between them.
struct MaterialPair {
  std::string name;                ///< "first/second"
  std::vector<int> first, second;  ///< velocity fields of each (more than one where a thin tool parts a body)
  ContactLaw law;
};

struct MaterialContactSettings {
  NormalRule normals;
  DetectionRule detection;
  std::vector<MaterialPair> pairs;
  GeometryKind geometry = GeometryKind::solid;
  double cell_volume =
      0.0;  ///< to which minimum volumes are relative [m^3]; about an axis the area of a cell's section
  int threads = 1;
  HeatSink* heat = nullptr;       ///< receiver of friction and touch, if there is heat
  Communicator* ranks = nullptr;  ///< communicator of a run over several ranks; else null
  const ToolSides* sides =
      nullptr;  ///< sides of thin tools, which may lie between two bodies at a node; null without such tools
};

class MaterialContact final : public Stage, public ContactReporter {
 public:
  /// `fields` and `survey` must outlive the stage.
  MaterialContact(MaterialContactSettings settings, Fields& fields, VolumeSurvey& survey);

  std::string name() const override { return "pairs"; }
  Ranks ranks(Hook) const override { return {Rank::pair}; }

  /// @throws FunctionError as ContactLaw::in_step().
  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override;
  void share_memory(Communicator& ranks) override { nodes_.share_memory(ranks); }
  void serialise(StateArchive& archive) override;

  void energies(EnergyReport& report) const override;
  /// Adds a reader, whose reports begin at the time `now` [s], and returns its number. A run that reads a checkpoint
  /// must have added the same readers before.
  int add_reader(double now);
  void read_pairs(double now, std::vector<PairReport>& reports, int reader = 0) override;

 private:
  using Member = ContactNodes::Member;
  using PairOfNode = ContactNodes::PairOfNode;
  using Node = ContactNodes::Node;
  using BlockNodes = ContactNodes::Block;

  /// Sums over a pair's nodes, of a step or since the start.
  struct Sums {
    Vec3 impulse = Vec3::Zero(), friction = Vec3::Zero(), moment = Vec3::Zero();
    double pressed = 0.0, area = 0.0, friction_energy = 0.0, interface_energy = 0.0;
    int nodes = 0;
    Sums& operator+=(const Sums& other);
  };
  /// The sums of each pair at a reader's last call.
  struct Reader {
    double time = 0.0;  ///< time of its last call [s]
    std::vector<Sums> seen;
  };
  /// Returns what has been added to sums since `seen`, with area, interface energy and nodes of the last step.
  Sums since(const Sums& seen, std::size_t pair) const;
  /// Replaces each by its sum over all ranks.
  void add_up(std::vector<Sums>& sums) const;
  static void serialise_sums(StateArchive& archive, std::vector<Sums>& sums);

  /// The pair whose law holds between two fields (-1: none), and whether the first field belongs to its second body.
  struct Rule {
    int pair = -1;
    bool turned = false;
  };
  /// True if a thin tool lies between the materials of two fields at a node.
  bool parted(const Member& a, const Member& b) const;
  Rule rule(int a, int b) const { return rules_[a * static_cast<int>(fields_.size()) + b]; }

  // Finding the nodes (material_nodes.cpp).
  void find_surveyed();
  void find_nodes(const SharedBlock& block, double dt, BlockNodes& found) const;
  /// Makes one group of the fields that share one velocity. Returns the number of groups.
  int group(Member* members, int count) const;
  NodeMaterial material_at(const Member& member, const Vec3& position) const;
  void add_pairs(Node& node, const std::array<bool, 3>& mirrored, double dt, BlockNodes& found) const;
  /// True if the block's nodes count in sums on this rank.
  bool counts(const BlockNodes& block) const;
  void book(const BlockNodes& block, bool updated, double dt);
  void tell_of_heat(const BlockNodes& block, const Node& node, const NodePair& pair, double dt);

  MaterialContactSettings settings_;
  Fields& fields_;
  VolumeSurvey& survey_;
  SurveyWants wants_;
  std::vector<Rule> rules_;  ///< rule of every two fields
  std::vector<NodalVolumes> volumes_;
  std::vector<FrictionLaw> friction_;  ///< friction of each pair, in this step
  SharedBlocks shared_;
  std::vector<double> surveyed_;  ///< for each field, 1 if a block of it is shared, else 0
  ContactNodes nodes_;            ///< a block of each shared block
  bool started_ = false;
  std::vector<Sums> last_, total_;  ///< sums of each pair, in the last step and since the start
  std::vector<Reader> readers_;
  ImpulseAccount account_;
  Vec3 left_over_ = Vec3::Zero();  ///< rest of this step's impulses, by own normals [N s]
};

}  // namespace mpm
