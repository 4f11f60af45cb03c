#include "mpm_ros/record/crack_lines.hpp"

#include <algorithm>
#include <limits>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {
namespace {

constexpr float kNotThere = std::numeric_limits<float>::quiet_NaN();

/// Numbers of tips that are shown: what the chain has at every point is not among them.
std::vector<TipQuantity> shown_of_tips() {
  std::vector<TipQuantity> list;
  for (const TipQuantity& one : tip_quantities()) {
    if (one.name == "j" || one.name == "k_one" || one.name == "k_two") list.push_back(one);
  }
  return list;
}

/// Direction of the chain at a point, from the points beside it; zero where they lie on one another.
mpm::Vec3 tangent_at(const Crack& crack, std::size_t k) {
  const mpm::Vec3 begin = from_message(crack.points.at(k == 0 ? 0 : k - 1));
  const mpm::Vec3 end = from_message(crack.points.at(std::min(k + 1, crack.points.size() - 1)));
  return (end - begin).normalized();
}

/// The tip at a point of a crack, or none.
const CrackTip* tip_at(const Cracks& message, const Crack& crack, std::size_t k) {
  const std::string end = k == 0 ? "start" : k + 1 == crack.points.size() ? "end" : "";
  for (const CrackTip& tip : message.tips) {
    if (tip.crack == crack.name && tip.end == end) return &tip;
  }
  return nullptr;
}

}  // namespace

VtkFile crack_lines(double time, const Cracks& message, bool fine) {
  std::vector<double> places;
  std::vector<float> opening, slip, normal_traction, shear_traction;
  const std::vector<TipQuantity> of_tips = shown_of_tips();
  std::vector<std::vector<float>> at_tips(of_tips.size());
  std::vector<std::uint32_t> numbers, faces, debonded;
  std::vector<std::size_t> lengths;
  for (std::size_t i = 0; i < message.cracks.size(); ++i) {
    const Crack& crack = message.cracks[i];
    for (const std::uint32_t face : {1U, 2U}) {
      lengths.push_back(crack.points.size());
      for (std::size_t k = 0; k < crack.points.size(); ++k) {
        const mpm::Vec3 above = from_message(crack.above.at(k)), below = from_message(crack.below.at(k));
        for (const double coordinate : face == 1 ? above : below) places.push_back(coordinate);
        const mpm::Vec3 tangent = tangent_at(crack, k), left(-tangent.z(), 0.0, tangent.x());
        opening.push_back(static_cast<float>((above - below).dot(left)));
        slip.push_back(static_cast<float>((above - below).dot(tangent)));
        normal_traction.push_back(static_cast<float>(crack.normal_traction.at(k)));
        shear_traction.push_back(static_cast<float>(crack.shear_traction.at(k)));
        debonded.push_back(crack.debonded.at(k) ? 1 : 0);
        numbers.push_back(static_cast<std::uint32_t>(i + 1));
        faces.push_back(face);
        const CrackTip* tip = tip_at(message, crack, k);
        for (std::size_t n = 0; n < of_tips.size(); ++n) {
          at_tips[n].push_back(tip ? static_cast<float>(std::get<double>(of_tips[n].of_message(*tip))) : kNotThere);
        }
      }
    }
  }
  VtkFile file(time, places, fine);
  file.draw_lines(lengths);
  file.add("crack", numbers);
  file.add("face", faces);
  file.add("opening", opening);
  file.add("slip", slip);
  file.add("normal_traction", normal_traction);
  file.add("shear_traction", shear_traction);
  file.add("debonded", debonded);
  for (std::size_t i = 0; i < of_tips.size(); ++i) file.add(of_tips[i].name, at_tips[i]);
  return file;
}

}  // namespace mpm_ros
