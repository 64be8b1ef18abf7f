#pragma once
/// The picture that a specimen is taken from.

#include <mpm/micrograph/image.hpp>
#include <mpm/scene/scene.hpp>

#include <array>
#include <optional>

namespace mpm::micrograph {

/// The part of a micrograph, or of each slice of a stack, that becomes the specimen, upright.
struct Picture {
  GrayImage image;
  std::array<double, 2> size;  ///< m
};

/// Reads the scene's picture; nothing if the specimen is made of shapes. Not collective.
/// Throws InputError (missing, unreadable or unsuitable image; size unknown).
std::optional<Picture> read_picture(const scene::Scene& scene);

/// Throws `error` again with the scene's file before it, where there is one.
[[noreturn]] void throw_in_scene(const scene::Scene& scene, const std::string& error);

}  // namespace mpm::micrograph
