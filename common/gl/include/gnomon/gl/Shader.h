#pragma once

#include <gnomon/gl/Handle.h>

#include <span>
#include <string_view>
#include <vector>

namespace gnomon::gl {

struct ShaderStage {
    GLenum type = GL_VERTEX_SHADER;
    /// Source text, joined as it stands; the first part begins with `#version 450 core`.
    std::vector<std::string_view> parts = {};
};

/// Compiles and links a program and labels it. Errors (Errc::shader): the label, the stage and
/// what the driver said, beside each line of that the source line it is about.
Result<Program> buildProgram(const Api& gl, std::string_view label,
                             std::span<const ShaderStage> stages);

}  // namespace gnomon::gl
