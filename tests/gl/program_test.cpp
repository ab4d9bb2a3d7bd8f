// Programs, passes, images and timers, as effects use them.
#include <cstring>

#include <gtest/gtest.h>

#include "core/shader_text.h"
#include "gl/program_source.h"
#include "support.h"

namespace brume::test {
namespace {

class Programs : public testing::Test {
protected:
    std::unique_ptr<Backend> backend = owned_backend();

    Failure compile_failure(const std::string &source, const std::string &defines = "")
    {
        return failure_of([&] { backend->invoke([&] { backend->compile("mine.comp", source, defines); }); });
    }

    // The first float that `source`'s `result` image gets.
    float evaluate(const std::string &source, const std::string &defines = "", const brume_plugin_scene &scene = {})
    {
        float value = -1;
        backend->invoke([&] {
            auto program = backend->compile("mine.comp", source, defines);
            const brume_image output = host_image(&value, 1, 1, 1);
            auto target = backend->begin_output(output, 1, true);
            Pass("evaluate", *program, 1, 1).bind("result", *target, BRUME_ACCESS_WRITE).run(*backend, scene);
            backend->finish_output(output, *target);
        });
        return value;
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
    backend->invoke([&] {
        auto first = backend->compile("a", scale_source, "");
        EXPECT_EQ(backend->compile("a", scale_source, ""), first);
        EXPECT_NE(backend->compile("a", scale_source, "#define X"), first);
    });
}

TEST_F(Programs, SceneUniforms)
{
    const std::string declared = "#include \"scene.glsl\"\nuniform Medium brume_medium;\nuniform Camera brume_camera;\n"
                                 "uniform float brume_output_limit;\n";
    brume_plugin_scene scene{};
    scene.medium.scattering[1] = 2;
    scene.medium.term_count = 3;
    scene.medium.terms[2][3] = 5;
    scene.camera.center[1] = 7;
    scene.camera.sky = 2;
    scene.output_limit = 65504;
    const std::string at = storing("brume_medium.scattering.y * 1000.0 + brume_medium.terms[brume_medium.term_count - 1].w "
                                   "* 100.0 + brume_camera.center.y * 10.0 + float(brume_camera.sky)",
                                   declared);
    EXPECT_EQ(evaluate(at, "", scene), 2572.0f);
    scene.camera.sky = 1;
    EXPECT_EQ(evaluate(at, "", scene), 2571.0f);
    EXPECT_EQ(evaluate(storing("brume_output_limit", declared), "", scene), 65504.0f);
}

TEST_F(Programs, PassesSampleAndChain)
{
    const std::vector<float> source = {1, 2, 3, 4, 5, 6, 7, 8};  // two RGBA pixels
    std::vector<float> result(8);
    backend->invoke([&] {
        const brume_image from = host_image(const_cast<float *>(source.data()), 2, 1, 4);
        const brume_image to = host_image(result.data(), 2, 1, 4);
        auto scale = backend->compile("scale", scale_source, "");
        auto blend = backend->compile("blend", R"(
uniform sampler2D source;
writeonly uniform image2D target;
uniform vec2 offset[2];
void main() { imageStore(target, ivec2(gl_GlobalInvocationID.x & 1u, 0), textureLod(source, offset[gl_GlobalInvocationID.x & 1u], 0.0)); }
)",
                                      "");
        auto image = backend->import(from, 4);
        auto middle = backend->create_image(2, 1, 4, BRUME_PIXEL_F32);
        auto output = backend->begin_output(to, 4, true);
        Pass("scale", *scale, 2, 1)
            .bind("source", *image, BRUME_ACCESS_FETCH)
            .bind("target", *middle, BRUME_ACCESS_WRITE)
            .bind("not there", *image, BRUME_ACCESS_FETCH)
            .set("factor", std::vector{2.0f})
            .set("unused", std::vector{1})
            .run(*backend);
        Pass pass("blend", *blend, 2, 1);
        const float offset[] = {-1.0f, 0.5f, 0.5f, 0.5f};  // clamped to the first pixel; between the two
        pass.bind("source", *middle, BRUME_ACCESS_LINEAR).bind("target", *output, BRUME_ACCESS_WRITE);
        pass.uniforms.push_back({"offset", BRUME_UNIFORM_FLOAT, 2, 2, 0, offset});
        pass.run(*backend);
        backend->finish_output(to, *output);
    });
    EXPECT_EQ(result, (std::vector<float>{2, 4, 6, 8, 6, 8, 10, 12}));
}

TEST_F(Programs, MistakesOfEffectsAreNamed)
{
    backend->invoke([&] {
        auto program = backend->compile("scale", scale_source, "");
        auto image = backend->create_image(4, 4, 4, BRUME_PIXEL_F32);
        auto good = [&] {
            Pass pass("p", *program, 4, 4);
            pass.bind("source", *image, BRUME_ACCESS_FETCH).bind("target", *image, BRUME_ACCESS_WRITE);
            return pass;
        };
        auto message = [&](const std::function<void(Pass &)> &spoil) {
            Pass pass = good();
            spoil(pass);
            const Failure failure = failure_of([&] { pass.run(*backend); });
            EXPECT_EQ(failure.status, BRUME_ERROR_ARGUMENT) << failure.message;
            return failure.message;
        };
        auto expect = [](const std::string &text, const char *part) {
            EXPECT_NE(text.find(part), std::string::npos) << text;
        };
        EXPECT_EQ(failure_of([&] { good().run(*backend); }).status, BRUME_OK);
        expect(message([](Pass &p) { p.pass.program = nullptr; }), "program is NULL");
        expect(message([](Pass &p) { p.pass.name = nullptr; }), "name is NULL");
        expect(message([](Pass &p) { p.pass.width = 0; }), "0 x 4");
        expect(message([](Pass &p) { p.bindings[0].name = nullptr; }), "bindings[0]: its name is NULL");
        expect(message([](Pass &p) { p.bindings[1].image = nullptr; }), "\"target\": its image is NULL");
        expect(message([](Pass &p) { p.bindings[0].access = 7; }), "access 7");
        expect(message([](Pass &p) { p.bindings[0].access = BRUME_ACCESS_WRITE; }), "sampler2D");
        expect(message([](Pass &p) { p.bindings[1].access = BRUME_ACCESS_LINEAR; }), "image2D");
        expect(message([](Pass &p) { p.set("factor", std::vector{1.0f, 2.0f}); }), "is float");
        expect(message([](Pass &p) { p.set("factor", std::vector{1}); }), "is float");
        expect(message([](Pass &p) { p.set("brume_grid", std::vector{1, 1}); }), "set by the host");
        expect(message([](Pass &p) { p.set("factor", std::vector<float>(5)); }), "5 components");
        expect(message([](Pass &p) { p.uniforms.push_back({"factor", 9, 1, 1, 0, &p}); }), "type 9");
        expect(message([](Pass &p) { p.uniforms.push_back({"factor", 0, 1, 0, 0, &p}); }), "count 0");
        expect(message([](Pass &p) { p.uniforms.push_back({"factor", 0, 1, 1, 0, nullptr}); }), "data is NULL");
        expect(message([](Pass &p) { p.uniforms.push_back({nullptr, 0, 1, 1, 0, &p}); }), "name is NULL");
    });
}

// Not what the host, or the pass before, has on that unit.
TEST_F(Programs, UnboundImagesReadAsZeroAndDropWrites)
{
    EXPECT_EQ(evaluate(storing("texelFetch(missing, ivec2(0), 0).x + 1.0", "uniform sampler2D missing;")), 1.0f);
    backend->invoke([&] {
        auto program = backend->compile("mine.comp", storing("1.0"), "");
        Pass("evaluate", *program, 1, 1).run(*backend);
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
    std::shared_ptr<Program> program;
    std::unique_ptr<FrameTimer> timer;
    backend->invoke([&] {
        image = backend->create_image(8, 8, 1, BRUME_PIXEL_F16);
        program = backend->compile("scale", scale_source, "");
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
        auto program = backend->compile("scale", scale_source, "");
        auto from = backend->create_image(512, 512, 4, BRUME_PIXEL_F32);
        auto to = backend->create_image(512, 512, 4, BRUME_PIXEL_F32);
        auto frame = [&] {
            timer->begin();
            for (int entry : {0, 1, 0, -1}) {
                timer->mark(entry);
                Pass("p", *program, 512, 512)
                    .bind("source", *from, BRUME_ACCESS_FETCH)
                    .bind("target", *to, BRUME_ACCESS_WRITE)
                    .run(*backend);
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

TEST_F(Programs, CpuServicesAreRefused)
{
    backend->invoke([&] {
        auto image = backend->create_image(1, 1, 1, BRUME_PIXEL_F32);
        EXPECT_EQ(failure_of([&] { backend->rows(1, 1, nullptr, nullptr); }).status, BRUME_ERROR_INTERNAL);
        EXPECT_EQ(failure_of([&] { backend->pixels(*image); }).status, BRUME_ERROR_INTERNAL);
    });
    EXPECT_EQ(failure_of([&] { backend->flush(); }).status, BRUME_ERROR_INTERNAL) << "outside invoke()";
}

}  // namespace
}  // namespace brume::test
