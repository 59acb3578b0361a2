#include "engine/view_gl/gl_program.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "engine/view_gl/shader_sources.h"

namespace acentric {
namespace {

constexpr std::size_t kLongestLog = 1000;

Result<std::string_view> sourceOf(std::string_view name) {
  for (const ShaderSource& source : shaderSources())
    if (source.name == name) return source.text;
  return fail(ErrorKind::internal, "no such shader was embedded at build", std::string(name));
}

/// Replaces each line `#include "file"` by that file (one level deep: shaders include leaves only).
Result<std::string> withIncludes(std::string_view text) {
  constexpr std::string_view kDirective = "#include \"";
  std::string out;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.substr(0, kDirective.size()) == kDirective) {
      const std::string_view rest = line.substr(kDirective.size());
      const Result<std::string_view> included = sourceOf(rest.substr(0, rest.find('"')));
      if (!included) return tl::unexpected(included.error());
      out += *included;
    } else {
      out += line;
    }
    out += '\n';
  }
  return out;
}

std::string trimmed(std::string log) {
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  if (log.size() > kLongestLog) log.resize(kLongestLog);
  return log;
}

Result<GlShader> compile(GLenum stage, const char* file, const std::string& head) {
  const Result<std::string_view> source = sourceOf(file);
  if (!source) return tl::unexpected(source.error());
  const Result<std::string> text = withIncludes(*source);
  if (!text) return tl::unexpected(text.error());
  GlShader shader = GlShader::adopt(glCreateShader(stage));
  const std::array<const GLchar*, 2> parts = {head.c_str(), text->c_str()};
  glShaderSource(shader.name(), GLsizei(parts.size()), parts.data(), nullptr);
  glCompileShader(shader.name());
  GLint compiled = 0, length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(length > 0 ? length : 0), '\0');
  if (length > 0) glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
  return fail(ErrorKind::internal, fmt::format("the driver does not compile it: {}", trimmed(std::move(log))),
              fmt::format("shader {}", file));
}

Result<GlProgramName> link(const GlShader& vertex, const GlShader& fragment, const std::string& key) {
  GlProgramName program = GlProgramName::make();
  glAttachShader(program.name(), vertex.name());
  glAttachShader(program.name(), fragment.name());
  glLinkProgram(program.name());
  glDetachShader(program.name(), vertex.name());
  glDetachShader(program.name(), fragment.name());
  GLint linked = 0, length = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(length > 0 ? length : 0), '\0');
  if (length > 0) glGetProgramInfoLog(program.name(), length, nullptr, log.data());
  return fail(ErrorKind::internal, fmt::format("the driver does not link it: {}", trimmed(std::move(log))),
              fmt::format("shaders {}", key));
}

}  // namespace

GLint GlProgram::location(const char* uniform) {
  if (const auto known = locations_.find(std::string_view(uniform)); known != locations_.end())
    return known->second;
  const GLint location = glGetUniformLocation(name_.name(), uniform);
  locations_.emplace(uniform, location);
  return location;
}

Result<GlProgram*> ProgramCache::get(const char* vertexFile, const char* fragmentFile,
                                     const Defines& defines) {
  std::string key = fmt::format("{} {}", vertexFile, fragmentFile);
  std::string head = "#version 430 core\n";
  for (const std::string& define : defines) {
    key += ' ' + define;
    head += fmt::format("#define {} 1\n", define);
  }
  if (const auto known = programs_.find(key); known != programs_.end()) return &known->second;
  head += "#line 1\n";
  const Result<GlShader> vertex = compile(GL_VERTEX_SHADER, vertexFile, head);
  if (!vertex) return tl::unexpected(vertex.error());
  const Result<GlShader> fragment = compile(GL_FRAGMENT_SHADER, fragmentFile, head);
  if (!fragment) return tl::unexpected(fragment.error());
  Result<GlProgramName> program = link(*vertex, *fragment, key);
  if (!program) return tl::unexpected(program.error());
  return &programs_.emplace(std::move(key), GlProgram(std::move(*program))).first->second;
}

std::vector<std::string> ProgramCache::variants() const {
  std::vector<std::string> names;
  for (const auto& entry : programs_) names.push_back(entry.first);
  return names;
}

}  // namespace acentric
