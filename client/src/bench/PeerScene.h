#pragma once

#include <gnomon/scene/FlatScene.h>

#include <filesystem>

namespace gnomon::client {

/// All triangles that exact rays see, in world space, for programs that do not read our formats.
/// The file, little-endian: u32 number of parts; each u32 vertices, u32 indices, 3 floats a vertex
/// in metres, u32 an index. A part is a chunk of about a thousand triangles that lie together.
/// Masked triangles are whole there: what they leave out, peers do not know of.
/// @throws Failure Errc::file
void writePeerScene(const std::filesystem::path& file, const scene::FlatScene& flat);

}  // namespace gnomon::client
