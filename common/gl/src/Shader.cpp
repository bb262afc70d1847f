#include <fmt/core.h>
#include <gnomon/gl/Shader.h>

#include <charconv>
#include <optional>
#include <string>
#include <utility>

namespace gnomon::gl {
namespace {

std::string_view stageName(GLenum type) {
    switch (type) {
        case GL_VERTEX_SHADER:
            return "vertex shader";
        case GL_TESS_CONTROL_SHADER:
            return "tessellation control shader";
        case GL_TESS_EVALUATION_SHADER:
            return "tessellation evaluation shader";
        case GL_GEOMETRY_SHADER:
            return "geometry shader";
        case GL_FRAGMENT_SHADER:
            return "fragment shader";
        case GL_COMPUTE_SHADER:
            return "compute shader";
        default:
            return "shader of unknown type";
    }
}

/// Cuts the first line off @p text.
std::string_view takeLine(std::string_view& text) {
    const auto end = text.find('\n');
    const auto line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

std::string_view lineOf(std::string_view source, int number) {
    for (int i = 1; i < number && !source.empty(); ++i) takeLine(source);
    return takeLine(source);
}

/// The source line a driver's message is about: Mesa and Intel write `0:12(5): `, NVIDIA
/// `0(12) : `, AMD `ERROR: 0:12: `.
std::optional<int> lineNumber(std::string_view message) {
    if (message.starts_with("ERROR: ") || message.starts_with("WARNING: "))
        message.remove_prefix(message.find(' ') + 1);
    const char* end = message.data() + message.size();
    int number = 0;
    auto [next, error] = std::from_chars(message.data(), end, number);  // which source string
    if (error != std::errc{} || next == end || (*next != ':' && *next != '(')) return {};
    const auto [after, wrong] = std::from_chars(next + 1, end, number);
    if (wrong != std::errc{} || after == end || (*after != ':' && *after != '(' && *after != ')'))
        return {};
    return number;
}

/// @p log, each line of it that names a source line followed by that line.
std::string explained(std::string_view log, std::string_view source) {
    // A #line directive renumbers, and then quoting by number would quote the wrong line.
    const bool quotes = source.find("#line") == std::string_view::npos;
    std::string text;
    while (!log.empty()) {
        const auto message = takeLine(log);
        if (message.find_first_not_of(std::string_view{" \r\0", 3}) == std::string_view::npos)
            continue;
        text += fmt::format("\n  {}", message);
        if (const auto number = lineNumber(message); quotes && number && *number > 0)
            text += fmt::format("\n    line {}: {}", *number, lineOf(source, *number));
    }
    return text.empty() ? " the driver gave no reason" : text;
}

template <class GetParameter, class GetLog>
std::string infoLog(GLuint id, GetParameter getParameter, GetLog getLog) {
    GLint length = 0;  // counts the terminating zero
    getParameter(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length > 0 ? length : 0), '\0');
    GLsizei written = 0;
    if (length > 0) getLog(id, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

Result<Shader> compiled(const Api& gl, std::string_view label, const ShaderStage& stage) {
    Shader shader{gl, stage.type};
    if (!shader)
        return fail(Errc::shader, fmt::format("shader program \"{}\": {:#x} is not a shader type",
                                              label, stage.type));
    std::string source;
    for (const auto part : stage.parts) source += part;
    const GLchar* text = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl.ShaderSource(shader.id(), 1, &text, &length);
    gl.CompileShader(shader.id());
    GLint ok = GL_FALSE;
    gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_FALSE)
        return fail(
            Errc::shader,
            fmt::format(
                "shader program \"{}\": {} does not compile:{}", label, stageName(stage.type),
                explained(infoLog(shader.id(), gl.GetShaderiv, gl.GetShaderInfoLog), source)));
    shader.label(fmt::format("{} {}", label, stageName(stage.type)));
    return shader;
}

}  // namespace

Result<Program> buildProgram(const Api& gl, std::string_view label,
                             std::span<const ShaderStage> stages) {
    Program program{gl};
    std::string names;
    for (const auto& stage : stages) {
        auto shader = compiled(gl, label, stage);
        if (!shader) return tl::unexpected{std::move(shader).error()};
        // The program keeps an attached shader alive after its handle is gone, and frees it with
        // itself.
        gl.AttachShader(program.id(), shader->id());
        names += fmt::format("{}{}", names.empty() ? "" : " + ", stageName(stage.type));
    }
    gl.LinkProgram(program.id());
    GLint ok = GL_FALSE;
    gl.GetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE)
        return fail(
            Errc::shader,
            fmt::format(
                "shader program \"{}\": {} do not link:{}", label, names,
                explained(infoLog(program.id(), gl.GetProgramiv, gl.GetProgramInfoLog), {})));
    program.label(label);
    return program;
}

}  // namespace gnomon::gl
