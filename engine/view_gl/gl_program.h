#pragma once
/// Shader programs from the embedded files, in variants: a variant is a set of #defines, compiled when first
/// used. So an effect that is off costs no branch and no compile time.

#include <map>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/view_gl/gl_object.h"

namespace acentric {

/// One linked program; uniform locations are asked once.
class GlProgram {
 public:
  explicit GlProgram(GlProgramName name) : name_(std::move(name)) {}
  void use() const { glUseProgram(name_.name()); }
  /// -1 (which glUniform ignores) where the variant has no such uniform.
  GLint location(const char* uniform);

 private:
  GlProgramName name_;
  std::map<std::string, GLint, std::less<>> locations_;
};

using Defines = std::vector<std::string>;

/// The programs compiled so far, by files and defines.
class ProgramCache {
 public:
  /// `vertexFile` and `fragmentFile` name files of shaders/. The pointer stays valid while the cache lives.
  Result<GlProgram*> get(const char* vertexFile, const char* fragmentFile, const Defines& defines);
  /// One line each: "points.vert points.frag SPLAT".
  std::vector<std::string> variants() const;

 private:
  std::map<std::string, GlProgram> programs_;
};

}  // namespace acentric
