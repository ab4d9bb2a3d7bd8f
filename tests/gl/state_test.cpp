// The contract of docs/gl-state.md.
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "plan/idle_images.h"
#include "gl/state_guard.h"
#include "host_state.h"
#include "support.h"

namespace brume::test {
namespace {

constexpr int32_t width = 24, height = 10;

// Everything a frame does, on a texture and on host memory that needs both kinds of transfer.
void run_frame(Backend &backend, const brume_image &texture)
{
    const std::vector<float> source = ramp(width * height * 4);
    std::vector<float> packed(source.size()), repacked(width * height * 3);
    backend.invoke([&] {
        auto timer = backend.create_timer();
        timer->begin();
        const brume_image images[] = {host_image(packed.data(), width, height, 4),
                                      host_image(repacked.data(), width, height, 3), texture};
        for (const brume_image &output : images) {
            backend.check(output, "output", true);
            timer->mark(0);
            auto from = backend.import(host_image(const_cast<float *>(source.data()), width, height, 4), 4);
            auto to = backend.begin_output(output, 4, true);
            scale(backend, *from, *to, 2.0f, BRUME_ACCESS_LINEAR);
            backend.finish_output(output, *to);
        }
        timer->end();
        backend.flush();
    });
    for (size_t i = 0; i < source.size(); ++i)
        ASSERT_EQ(packed[i], 2 * source[i]) << i;
    for (size_t i = 0; i < repacked.size(); ++i)
        ASSERT_EQ(repacked[i], 2 * source[i / 3 * 4 + i % 3]) << i;
}

std::vector<float> read_texture(GLuint texture)
{
    std::vector<float> values(width * height * 4);
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * 4), values.data());
    return values;
}

class State : public testing::TestWithParam<bool> {
protected:
    HostContext context{GetParam() ? Profile::compatibility : Profile::core};
};
INSTANTIATE_TEST_SUITE_P(Profiles, State, testing::Bool(),
                         [](const auto &info) { return info.param ? "Compatibility" : "Core"; });

TEST_P(State, PreserveRestoresAllOfIt)
{
    const GLuint texture = make_texture(GL_RGBA16F, width, height);
    const brume_image image = texture_image(texture, width, height);
    const HostState initial = read_state(GetParam());
    dirty_state(GetParam());
    const HostState before = read_state(GetParam());
    for (const auto &[name, values] : before) {
        static const std::regex stays_clean(
            "GL_TRANSFORM_.*|GL_.*_COMPRESSED_.*|.*_LAYERED|GL_TEXTURE_BINDING_3D|"
            "GL_TEXTURE_CUBE_MAP_SEAMLESS|GL_(ARRAY|UNIFORM|DISPATCH_INDIRECT)_BUFFER_BINDING");
        if (!std::regex_match(name, stays_clean)) {
            EXPECT_NE(values, initial.at(name)) << name << " was not dirtied";
        }
    }
    {
        auto backend = borrowed_backend();
        EXPECT_EQ(difference(before, read_state(GetParam())), "") << "by creating the backend";
        for (int frame = 0; frame < 2; ++frame) {
            run_frame(*backend, image);
            EXPECT_EQ(difference(before, read_state(GetParam())), "") << "by frame " << frame;
        }
        EXPECT_EQ(failure_of([&] {
                      backend->invoke([&] {
                          auto scratch = backend->import(image, 4);
                          make_pass(*backend, describe("broken", {}, {}, 0, "nonsense"));
                      });
                  }).status,
                  BRUME_ERROR_GL);
        EXPECT_EQ(difference(before, read_state(GetParam())), "") << "by a failing call";
    }
    EXPECT_EQ(difference(before, read_state(GetParam())), "") << "by destroying the backend";
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_P(State, DefaultsLeavesInitialValues)
{
    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    HostState initial = read_state(GetParam());
    dirty_state(GetParam());
    const HostState before = read_state(GetParam());
    auto backend = borrowed_backend(BRUME_GL_STATE_DEFAULTS);
    run_frame(*backend, texture_image(texture, width, height));
    const HostState after = read_state(GetParam());

    std::set<std::string> listed;
    for (const std::string &name : gl::StateGuard::names())
        listed.insert(name);
    for (const auto &[name, values] : after) {
        if (!listed.contains(name)) {
            EXPECT_EQ(values, before.at(name)) << name << " is not on the list";
            continue;
        }
        // One texture unit and one image unit were used; the others keep what the host has there.
        EXPECT_EQ(values[0], initial.at(name)[0]) << name;
        for (size_t unit = 1; unit < values.size(); ++unit)
            EXPECT_EQ(values[unit], before.at(name)[unit]) << name << "[" << unit << "]";
    }
}

TEST_P(State, OwnedStillComputesRight)
{
    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    dirty_state(GetParam());
    auto backend = borrowed_backend(BRUME_GL_STATE_OWNED);
    run_frame(*backend, texture_image(texture, width, height));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<float> expected = ramp(width * height * 4);
    for (float &value : expected)
        value *= 2;
    EXPECT_EQ(read_texture(texture), expected);
}

TEST_P(State, WorksInsideTransformFeedback)
{
    const char *source = "#version 450 core\nout float captured;\nvoid main() { captured = 1.0; gl_Position = vec4(0); }\n";
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    const char *captured = "captured";
    glTransformFeedbackVaryings(program, 1, &captured, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glUseProgram(program);
    GLuint buffer = 0, array = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 64, nullptr, 0);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glCreateVertexArrays(1, &array);
    glBindVertexArray(array);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);

    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    auto backend = borrowed_backend();
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, 1);
    const HostState before = read_state(GetParam());
    run_frame(*backend, texture_image(texture, width, height));
    EXPECT_EQ(difference(before, read_state(GetParam())), "");
    glDrawArrays(GL_POINTS, 0, 1);
    glEndTransformFeedback();
    float values[2] = {};
    glGetNamedBufferSubData(buffer, 0, sizeof values, values);
    EXPECT_EQ(values[1], 1.0f);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_P(State, HostQueriesMayBeActive)
{
    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    GLuint queries[2] = {};
    glGenQueries(2, queries);
    auto backend = borrowed_backend();
    glBeginQuery(GL_TIME_ELAPSED, queries[0]);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, queries[1]);
    run_frame(*backend, texture_image(texture, width, height));
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glEndQuery(GL_TIME_ELAPSED);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// The debug group stack may be full: passes then go without.
TEST_P(State, FullDebugStack)
{
    const GLuint texture = make_texture(GL_RGBA32F, width, height);
    auto backend = borrowed_backend();
    GLint most = 0;
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
    for (int depth = 1; depth < most; ++depth)
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "deep");
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    run_frame(*backend, texture_image(texture, width, height));
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

std::string state_document()
{
    std::ifstream file(BRUME_GL_STATE_DOCUMENT);
    EXPECT_TRUE(file) << BRUME_GL_STATE_DOCUMENT;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(StateDocument, ListsWhatIsGuarded)
{
    const std::string document = state_document();
    const size_t begin = document.find("## What is preserved"), end = document.find("\n## ", begin + 1);
    ASSERT_NE(begin, std::string::npos);
    std::set<std::string> documented, guarded;
    const std::regex item(R"((^|\n)(- [^\n]*(\n  [^\n]*)*))"), name("`(GL_[A-Z0-9_]+)`");
    const std::string section = document.substr(begin, end - begin);
    for (std::sregex_iterator i(section.begin(), section.end(), item), none; i != none; ++i) {
        const std::string line = (*i)[2];
        for (std::sregex_iterator n(line.begin(), line.end(), name); n != none; ++n)
            documented.insert((*n)[1]);
    }
    for (const std::string &guarded_name : gl::StateGuard::names())
        guarded.insert(guarded_name);
    EXPECT_EQ(documented, guarded);
}

TEST(StateDocument, SaysHowLongTexturesAreKept)
{
    EXPECT_NE(state_document().find("kept for " + std::to_string(idle_frames) + " frames"), std::string::npos);
}

}  // namespace
}  // namespace brume::test
