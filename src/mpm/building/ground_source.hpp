// Ground of a scene for runs in which it follows bodies: a filling of the body that is asked for a part of it at a
// time. Private to this folder.
#pragma once

#include "filling.hpp"
#include "mpm/bed/bed_definition.hpp"

namespace mpm {

class SceneGround final : public GroundSource {
 public:
  /// Takes the body of that number. Keeps a copy of the scene. @throws SceneError
  SceneGround(const Scene& scene, std::size_t body)
      : scene_(scene), body_(scene_.bodies[body]), filling_(body_, scene_, nullptr) {}
  SceneGround(const SceneGround&) = delete;
  SceneGround& operator=(const SceneGround&) = delete;

  void add(const Box& bounds, GroundParticles& ground) const override;
  bool cuts() const override { return filling_.cuts(); }
  Vec3 origin() const override { return filling_.origin(); }
  Vec3 spacing() const override { return filling_.spacing(); }
  double bottom() const override { return body_.region.bounds().min.z(); }
  double top() const override { return body_.region.bounds().max.z(); }
  const Filling& filling() const { return filling_; }

 private:
  const Scene scene_;
  const BodyDefinition& body_;
  Filling filling_;
};

}  // namespace mpm
