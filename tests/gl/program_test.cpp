// Programs, passes, images and timers, as effects use them.
#include <cstddef>
#include <cstring>

#include <gtest/gtest.h>

#include "effects/shader_text.h"
#include "gl/program_source.h"
#include "gl_calls.h"
#include "support.h"

namespace brume::test {
namespace {

class Programs : public testing::Test {
protected:
    std::unique_ptr<Backend> backend = owned_backend();

    // What making a pass of this shader throws.
    Failure compile_failure(const std::string &source, const std::string &defines = "")
    {
        return failure_of([&] { backend->invoke([&] { make(source, defines); }); });
    }

    // The first float that `source`'s `result` image gets.
    float evaluate(const std::string &source, const std::string &defines = "", const brume_plugin_scene &scene = {})
    {
        float value = -1;
        backend->invoke([&] {
            const auto pass = make(source, defines);
            const brume_image output = host_image(&value, 1, 1, 1);
            auto target = backend->begin_output(output, 1, true);
            const brume_plugin_image images[] = {target.get(), nullptr};
            backend->run(*pass, images, nullptr, 1, 1, scene, nullptr, nullptr);
            backend->finish_output(output, *target);
        });
        return value;
    }

    std::shared_ptr<Pass> make(const std::string &source, const std::string &defines = "")
    {
        const std::vector<brume_slot> slots = {{"result", BRUME_ACCESS_WRITE, 0}, {"missing", BRUME_ACCESS_FETCH, 0}};
        brume_pass_desc desc = describe("evaluate", slots, {}, 0, source.c_str());
        desc.source_name = "mine.comp";
        desc.defines = defines.c_str();
        return make_pass(*backend, desc);
    }
};

std::string storing(const std::string &expression, const std::string &before = "")
{
    return before + "\nwriteonly uniform image2D result;\nvoid main() { imageStore(result, ivec2(0), vec4(" + expression +
           ")); }\n";
}

TEST_F(Programs, DefinesAndIncludes)
{
    EXPECT_EQ(evaluate(storing("VALUE"), "#define VALUE 3.5"), 3.5f);
    EXPECT_EQ(evaluate(storing("VALUE"), "#define VALUE 4.5\n#define OTHER\n"), 4.5f);
    EXPECT_EQ(evaluate(storing("float(max_density_terms)", "#include \"scene.glsl\"\n  # include \"scene.glsl\" // again")),
              16.0f);
}

TEST_F(Programs, ErrorsNameTheFileAndLine)
{
    auto own = compile_failure("uniform float a;\n#include \"scene.glsl\"\nvoid main() {\n    nonsense();\n}\n");
    EXPECT_EQ(own.status, BRUME_ERROR_GL);
    EXPECT_NE(own.message.find("mine.comp:4"), std::string::npos) << own.message;

    auto included = compile_failure("#include \"density.glsl\"\nvoid main() {}\n");
    EXPECT_NE(included.message.find("density.glsl:"), std::string::npos) << included.message;

    auto defined = compile_failure("void main() {}\n", "#define A 1\nnonsense\n");
    EXPECT_NE(defined.message.find("mine.comp (defines):"), std::string::npos) << defined.message;
}

TEST_F(Programs, LogsOfAllDriversAreRewritten)
{
    const gl::ProgramSource source = gl::assemble_program("mine.comp", "one\ntwo\n", "");
    const std::string last = std::to_string(source.places.size());
    EXPECT_EQ(gl::with_file_names("0:" + last + "(3): error: x\n", source), "mine.comp:2(3): error: x");
    EXPECT_EQ(gl::with_file_names("0(" + last + ") : error C1008: x\n", source), "mine.comp:2 : error C1008: x");
    EXPECT_EQ(gl::with_file_names("ERROR: 0:2: 'x'\n", source), "ERROR: prelude.glsl:1: 'x'");
    EXPECT_EQ(gl::with_file_names("0:9999(3): error: x\nplain", source), "0:9999(3): error: x\nplain");
}

TEST_F(Programs, RefusesWhatCannotWork)
{
    auto unknown = compile_failure("\n#include \"nowhere.glsl\"\nvoid main() {}\n");
    EXPECT_EQ(unknown.status, BRUME_ERROR_GL);
    EXPECT_NE(unknown.message.find("mine.comp:2"), std::string::npos) << unknown.message;
    EXPECT_NE(unknown.message.find("nowhere.glsl"), std::string::npos) << unknown.message;
    EXPECT_EQ(compile_failure("#include <scene.glsl>\nvoid main() {}\n").status, BRUME_ERROR_GL);

    auto block = compile_failure("layout(std430, binding = 0) buffer Data { float x; };\nvoid main() { x = 1.0; }\n");
    EXPECT_EQ(block.status, BRUME_ERROR_GL);
    EXPECT_NE(block.message.find("storage blocks"), std::string::npos) << block.message;
    auto cube = compile_failure("uniform samplerCube sky;\n" + storing("textureLod(sky, vec3(1), 0.0).x"));
    EXPECT_NE(cube.message.find("sky"), std::string::npos) << cube.message;
    EXPECT_EQ(compile_failure("").status, BRUME_ERROR_GL);  // no main(): links fail
}

TEST_F(Programs, VeryLongLines)
{
    EXPECT_EQ(evaluate(storing("2.0", "// " + std::string(1 << 20, 'x'))), 2.0f);
    EXPECT_EQ(compile_failure("nonsense" + std::string(1 << 20, 'x')).status, BRUME_ERROR_GL);
}

TEST_F(Programs, SameTextsAreCompiledOnce)
{
    const auto programs_made = [&](const std::string &defines) {
        const QueryCount count;
        backend->invoke([&] { make(storing("1.0"), defines); });
        return QueryCount::of("glGetProgramiv") > 0;
    };
    EXPECT_TRUE(programs_made(""));
    EXPECT_FALSE(programs_made(""));
    EXPECT_TRUE(programs_made("#define X"));
}

TEST_F(Programs, SceneUniforms)
{
    const std::string declared = "#include \"scene.glsl\"\nuniform Medium brume_medium;\nuniform Camera brume_camera;\n"
                                 "uniform float brume_output_limit;\n";
    brume_plugin_medium medium{};
    medium.scattering[1] = 2;
    medium.term_count = 3;
    medium.terms[2][3] = 5;
    brume_plugin_camera camera{};
    camera.center[1] = 7;
    camera.sky = 2;
    brume_plugin_scene scene{};
    scene.medium = &medium;
    scene.camera = &camera;
    scene.output_limit = 65504;
    const std::string at = storing("brume_medium.scattering.y * 1000.0 + brume_medium.terms[brume_medium.term_count - 1].w "
                                   "* 100.0 + brume_camera.center.y * 10.0 + float(brume_camera.sky)",
                                   declared);
    EXPECT_EQ(evaluate(at, "", scene), 2572.0f);
    camera.sky = 1;
    EXPECT_EQ(evaluate(at, "", scene), 2571.0f);
    EXPECT_EQ(evaluate(storing("brume_output_limit", declared), "", scene), 65504.0f);
}

TEST_F(Programs, PassesSampleAndChain)
{
    const std::vector<float> source = {1, 2, 3, 4, 5, 6, 7, 8};  // two RGBA pixels
    std::vector<float> result(8);
    struct Constants {
        float unused;
        float offset[2][2];
    };
    backend->invoke([&] {
        const brume_image from = host_image(const_cast<float *>(source.data()), 2, 1, 4);
        const brume_image to = host_image(result.data(), 2, 1, 4);
        const std::vector<brume_slot> slots = {
            {"not there", BRUME_ACCESS_FETCH, 0}, {"source", BRUME_ACCESS_LINEAR, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
        const std::vector<brume_constant> constants = {{"unused", BRUME_CONSTANT_FLOAT, 1, 1, 0},
                                                       {"offset", BRUME_CONSTANT_FLOAT, 2, 2, offsetof(Constants, offset)}};
        const auto blend = make_pass(*backend, describe("blend", slots, constants, sizeof(Constants), R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform vec2 offset[2];
void main() { imageStore(target, ivec2(gl_GlobalInvocationID.x & 1u, 0), textureLod(source, offset[gl_GlobalInvocationID.x & 1u], 0.0)); }
)"));
        auto image = backend->import(from, 4);
        auto middle = backend->create_image(2, 1, 4, BRUME_PIXEL_F32);
        auto output = backend->begin_output(to, 4, true);
        scale(*backend, *image, *middle, 2.0f);
        const Constants given{7, {{-1.0f, 0.5f}, {0.5f, 0.5f}}};  // clamped to the first pixel; between the two
        const brume_plugin_image images[] = {image.get(), middle.get(), output.get()};
        backend->run(*blend, images, &given, 2, 1, brume_plugin_scene{}, nullptr, nullptr);
        backend->finish_output(to, *output);
    });
    EXPECT_EQ(result, (std::vector<float>{2, 4, 6, 8, 6, 8, 10, 12}));
}

// Passes and their shaders must agree: what nobody would set, or would set otherwise, is named.
TEST_F(Programs, MistakesOfEffectsAreNamed)
{
    const std::string good = storing("texelFetch(source, ivec2(0), 0) * factor + vec4(float(count))",
                                     "uniform sampler2D source;\nuniform float factor;\nuniform int count;");
    const std::vector<brume_slot> slots = {{"result", BRUME_ACCESS_WRITE, 0}, {"source", BRUME_ACCESS_FETCH, 0}};
    const std::vector<brume_constant> constants = {{"factor", BRUME_CONSTANT_FLOAT, 1, 1, 0},
                                                   {"count", BRUME_CONSTANT_INT, 1, 1, 4}};
    using Slots = std::vector<brume_slot>;
    using Constants = std::vector<brume_constant>;
    const auto failure = [&](const Slots &s, const Constants &c, const std::string &source) {
        return failure_of([&] { backend->invoke([&] { make_pass(*backend, describe("p", s, c, 8, source.c_str())); }); });
    };
    const auto refused = [&](const Slots &s, const Constants &c, brume_status status, const std::string &part) {
        const Failure got = failure(s, c, good);
        EXPECT_EQ(got.status, status) << got.message;
        EXPECT_NE(got.message.find(part), std::string::npos) << "no \"" << part << "\" in " << got.message;
    };
    EXPECT_EQ(failure(slots, constants, good).message, "");
    refused({slots[0]}, constants, BRUME_ERROR_ARGUMENT,
            "declares sampler2D source, which is not among the slots of pass \"p\"");
    refused({slots[1]}, constants, BRUME_ERROR_ARGUMENT, "declares image2D result, which is not among the slots");
    refused({slots[0], {"source", BRUME_ACCESS_WRITE, 0}}, constants, BRUME_ERROR_ARGUMENT,
            "declares source as sampler2D; pass \"p\" has a slot for writing there");
    refused({{"result", BRUME_ACCESS_LINEAR, 0}, slots[1]}, constants, BRUME_ERROR_ARGUMENT,
            "declares result as image2D; pass \"p\" has a slot for reading there");
    refused(slots, {constants[0]}, BRUME_ERROR_ARGUMENT,
            "declares int count, which is not among the constants of pass \"p\"");
    refused(slots, {{"factor", BRUME_CONSTANT_INT, 1, 1, 0}, constants[1]}, BRUME_ERROR_ARGUMENT,
            "declares factor as float; pass \"p\" has ints of 1 components there");
    refused(slots, {{"factor", BRUME_CONSTANT_FLOAT, 2, 1, 0}, {"count", BRUME_CONSTANT_INT, 1, 1, 0}}, BRUME_ERROR_ARGUMENT,
            "declares factor as float; pass \"p\" has floats of 2 components there");

    const auto host_uniform = [&](const std::string &declared, const std::string &used) {
        const Failure got = failure({slots[0]}, {}, storing("vec4(" + used + ")", declared));
        EXPECT_EQ(got.status, BRUME_ERROR_GL) << got.message;
        EXPECT_NE(got.message.find("is none that the host sets"), std::string::npos) << got.message;
    };
    host_uniform("uniform float brume_gird;", "brume_gird");
    host_uniform("uniform vec2 brume_output_limit;", "brume_output_limit.x");
    host_uniform("uniform struct { float scatering; } brume_medium;", "brume_medium.scatering");
    host_uniform("uniform struct { float scattering; } brume_medium;", "brume_medium.scattering");
}

// Not what the host, or the pass before, has on that unit.
TEST_F(Programs, UnboundImagesReadAsBlackAndDropWrites)
{
    const std::string declared = "uniform sampler2D missing;", texel = "texelFetch(missing, ivec2(0), 0)";
    EXPECT_EQ(evaluate(storing(texel + ".x + 1.0", declared)), 1.0f);
    EXPECT_EQ(evaluate(storing(texel + ".w + dot(" + texel + ".xyz, vec3(10.0))", declared)), 1.0f);
    backend->invoke([&] {
        const auto pass = make(storing("1.0"));
        const brume_plugin_image images[] = {nullptr, nullptr};
        backend->run(*pass, images, nullptr, 1, 1, brume_plugin_scene{}, nullptr, nullptr);
    });
}

TEST_F(Programs, ImagesArePooled)
{
    const auto age = [&] {
        backend->invoke([&] {
            for (int frame = 0; frame < 200; ++frame)
                backend->flush();
        });
    };
    age();
    const uint64_t before = backend->device_bytes();
    const Image *first = nullptr;
    backend->invoke([&] { first = backend->create_image(64, 32, 4, BRUME_PIXEL_F32).get(); });
    EXPECT_EQ(backend->device_bytes(), before + 64 * 32 * 16);
    for (int frame = 0; frame < 10; ++frame) {
        std::shared_ptr<Image> held;
        backend->invoke([&] {
            held = backend->create_image(64, 32, 4, BRUME_PIXEL_F32);
            EXPECT_EQ(held.get(), first);
            backend->flush();
        });
    }
    EXPECT_EQ(backend->device_bytes(), before + 64 * 32 * 16);
    age();
    EXPECT_EQ(backend->device_bytes(), before) << "nothing that has long been idle stays";
}

TEST_F(Programs, ImagesAndProgramsOutliveTheBackend)
{
    std::shared_ptr<Image> image;
    std::shared_ptr<Pass> pass;
    std::unique_ptr<FrameTimer> timer;
    backend->invoke([&] {
        image = backend->create_image(8, 8, 1, BRUME_PIXEL_F16);
        pass = make(storing("1.0"));
        timer = backend->create_timer();
        timer->begin();
        timer->end();
    });
    backend.reset();
}

TEST_F(Programs, ImagesOfImpossibleSizes)
{
    backend->invoke([&] {
        const int32_t largest = backend->largest_size();
        const Failure large = failure_of([&] { backend->create_image(largest + 1, 1, 4, BRUME_PIXEL_F32); });
        EXPECT_EQ(large.status, BRUME_ERROR_UNSUPPORTED);
        EXPECT_NE(large.message.find(std::to_string(largest)), std::string::npos) << large.message;
        EXPECT_EQ(failure_of([&] { backend->create_image(0, 1, 4, BRUME_PIXEL_F32); }).status, BRUME_ERROR_ARGUMENT);
        EXPECT_EQ(failure_of([&] { backend->create_image(1, 1, 3, BRUME_PIXEL_F32); }).status, BRUME_ERROR_ARGUMENT);
    });
}

TEST_F(Programs, DeviceMemoryThatRunsOut)
{
    if (backend->device().find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "only llvmpipe refuses 4 GiB at once";
    backend->invoke([&] {
        backend->create_image(256, 256, 4, BRUME_PIXEL_F32);  // idle, to be given up first
        const Failure failure = failure_of([&] { backend->create_image(16384, 16384, 4, BRUME_PIXEL_F32); });
        EXPECT_EQ(failure.status, BRUME_ERROR_MEMORY);
        EXPECT_NE(failure.message.find("16384 x 16384 x 4 floats, 4.3 GB"), std::string::npos) << failure.message;
        EXPECT_EQ(failure_of([&] { backend->create_image(256, 256, 4, BRUME_PIXEL_F32); }).status, BRUME_OK);
    });
}

TEST_F(Programs, Timers)
{
    backend->invoke([&] {
        auto timer = backend->create_timer();
        EXPECT_TRUE(timer->milliseconds(2).empty());
        auto from = backend->create_image(512, 512, 4, BRUME_PIXEL_F32);
        auto to = backend->create_image(512, 512, 4, BRUME_PIXEL_F32);
        auto frame = [&] {
            timer->begin();
            for (int entry : {0, 1, 0, -1}) {
                timer->mark(entry);
                scale(*backend, *from, *to, 1.0f);
            }
        };
        for (int i = 0; i < 3; ++i) {
            frame();
            timer->end();
        }
        const std::vector<double> times = timer->milliseconds(2);
        ASSERT_EQ(times.size(), 2u);
        EXPECT_GT(times[0], 0.0);
        EXPECT_GT(times[1], 0.0);
        EXPECT_LT(times[0], 10000.0);
        frame();  // not ended: the last ended one still answers
        EXPECT_EQ(timer->milliseconds(2), times);
    });
}

TEST_F(Programs, PassesWithoutAShaderAreRefused)
{
    const Failure got =
        failure_of([&] { backend->invoke([&] { make_pass(*backend, describe("p", {}, {}, 0, nullptr)); }); });
    EXPECT_EQ(got.status, BRUME_ERROR_UNSUPPORTED);
    EXPECT_NE(got.message.find("pass \"p\" has no shader"), std::string::npos) << got.message;
    EXPECT_EQ(failure_of([&] { backend->flush(); }).status, BRUME_ERROR_INTERNAL) << "outside invoke()";
}

}  // namespace
}  // namespace brume::test
