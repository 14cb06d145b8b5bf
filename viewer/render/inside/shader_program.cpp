#include "viewer/render/inside/shader_program.h"

#include <string_view>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/file_bytes.h"

namespace kerf::view {

namespace {

// Returns the driver's words for a shader or a program, by glGetShaderInfoLog or glGetProgramInfoLog.
template <class GetInfoLog>
std::string log_of(GLuint id, GetInfoLog get_info_log) {
    constexpr GLsizei log_size = 4096;
    std::string log(log_size, '\0');
    GLsizei length = 0;
    get_info_log(id, log_size, &length, log.data());
    return log.substr(0, length);
}

[[noreturn]] void refuse(const std::string& what, const std::string& log) {
    throw Error(ErrorCode::internal, fmt::format("The OpenGL driver refuses {}: {}", what, log));
}

// Deletes the shader when the program, which keeps it alive while it needs it, is linked or refused.
class Shader {
 public:
    Shader(const Gl& gl, GLenum kind, const std::string& path, const std::string& head)
        : gl_(gl), id_(gl.CreateShader(kind)) {
        const std::string text = head + read_file(path);
        const char* source = text.c_str();
        gl.ShaderSource(id_, 1, &source, nullptr);
        gl.CompileShader(id_);
        GLint good = 0;
        gl.GetShaderiv(id_, GL_COMPILE_STATUS, &good);
        if (good) return;
        const std::string log = log_of(id_, gl.GetShaderInfoLog);
        gl.DeleteShader(id_);
        refuse(path, log);
    }
    ~Shader() { gl_.DeleteShader(id_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    GLuint id() const { return id_; }

 private:
    const Gl& gl_;
    GLuint id_;
};

// Line numbers in the driver's messages are those of the file.
std::string head_of(const std::vector<std::string>& defines) {
    std::string head = "#version 330 core\n";
    for (const std::string& define : defines) head += "#define " + define + "\n";
    return head + "#line 1\n";
}

}  // namespace

ShaderProgram::ShaderProgram(const Gl& gl, const std::string& folder, const std::string& vertex_file,
                             const std::string& fragment_file, const std::vector<std::string>& defines)
    : gl_(gl) {
    const std::string head = head_of(defines);
    const Shader vertex(gl, GL_VERTEX_SHADER, folder + "/" + vertex_file, head);
    const Shader fragment(gl, GL_FRAGMENT_SHADER, folder + "/" + fragment_file, head);
    id_ = gl.CreateProgram();
    gl.AttachShader(id_, vertex.id());
    gl.AttachShader(id_, fragment.id());
    gl.LinkProgram(id_);
    GLint good = 0;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
    if (good) return;
    const std::string log = log_of(id_, gl.GetProgramInfoLog);
    gl.DeleteProgram(id_);
    refuse(vertex_file + " with " + fragment_file, log);
}

ShaderProgram::~ShaderProgram() { gl_.DeleteProgram(id_); }

GLint ShaderProgram::location(const char* uniform) {
    const auto found = locations_.find(std::string_view(uniform));
    if (found != locations_.end()) return found->second;
    return locations_.emplace(uniform, gl_.GetUniformLocation(id_, uniform)).first->second;
}

}  // namespace kerf::view
