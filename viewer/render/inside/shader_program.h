// Programs for the GPU from the files of the shader folder.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "viewer/render/inside/gl.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// A vertex and a fragment shader, linked.
class ShaderProgram {
 public:
    /// Compiles and links the two files in `folder`, which have no #version line; `defines` are switched on for #ifdef
    /// in both. Throws Error(io) if a file is missing, Error(internal) with the file and the driver's words if one does
    /// not compile.
    ShaderProgram(const Gl& gl, const std::string& folder, const std::string& vertex_file,
                  const std::string& fragment_file, const std::vector<std::string>& defines = {});
    ~ShaderProgram();
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    void use() const { gl_.UseProgram(id_); }

    // Sets a uniform of the program, which must be in use. Uniforms that the driver has optimised away are passed over.
    void set(const char* uniform, int value) { gl_.Uniform1i(location(uniform), value); }
    void set(const char* uniform, unsigned value) { gl_.Uniform1ui(location(uniform), value); }
    void set(const char* uniform, float value) { gl_.Uniform1f(location(uniform), value); }
    void set(const char* uniform, const Eigen::Vector2f& v) { gl_.Uniform2f(location(uniform), v[0], v[1]); }
    void set(const char* uniform, const Eigen::Vector3f& v) { gl_.Uniform3f(location(uniform), v[0], v[1], v[2]); }
    void set(const char* uniform, const std::array<float, 3>& v) { gl_.Uniform3f(location(uniform), v[0], v[1], v[2]); }
    void set(const char* uniform, const std::array<float, 4>& v) {
        gl_.Uniform4f(location(uniform), v[0], v[1], v[2], v[3]);
    }
    void set(const char* uniform, const Color& c) { gl_.Uniform4f(location(uniform), c.r, c.g, c.b, c.a); }
    void set(const char* uniform, const Eigen::Matrix4f& m) {
        gl_.UniformMatrix4fv(location(uniform), 1, GL_FALSE, m.data());
    }

 private:
    GLint location(const char* uniform);

    const Gl& gl_;
    GLuint id_ = 0;
    std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace kerf::view
