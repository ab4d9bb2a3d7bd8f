// Media through the C ABI: what goes in comes out, screen coordinates follow the camera and the depth, failures name things.
#include <cmath>
#include <filesystem>
#include <unistd.h>

#include <brume/brume_media.h>

#include "client.h"

using namespace client;

namespace {

class MediaAbi : public testing::Test {
protected:
    void SetUp() override
    {
        context = make_context();
        ASSERT_EQ(brume_media_create(context.get(), &media), BRUME_OK);
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
        camera.vertical_fov = 2 * std::atan(0.5);
        // At (10, 0, 2), looking along +y with +z up.
        const double pose[16] = {1, 0, 0, 10, 0, 0, -1, 0, 0, 1, 0, 2, 0, 0, 0, 1};
        std::copy_n(pose, 16, camera.camera_to_world);
        format.width = 80;
        format.height = 40;
        view.camera = &camera;
        view.format = &format;
    }
    void TearDown() override { brume_media_destroy(media); }

    brume_media_info info()
    {
        brume_media_info info = BRUME_MEDIA_INFO_INIT;
        EXPECT_EQ(brume_media_get_info(media, &info), BRUME_OK);
        return info;
    }
    std::vector<brume_gaussian> gaussians()
    {
        std::vector<brume_gaussian> all(info().gaussian_count, brume_gaussian BRUME_GAUSSIAN_INIT);
        EXPECT_EQ(brume_media_get_gaussians(media, 0, uint32_t(all.size()), all.data()), BRUME_OK) << message(context.get());
        return all;
    }
    void put(double x, double y, double z)
    {
        brume_gaussian gaussian = BRUME_GAUSSIAN_INIT;
        gaussian.center[0] = x, gaussian.center[1] = y, gaussian.center[2] = z;
        ASSERT_EQ(brume_media_put(media, &gaussian, 1), BRUME_OK) << message(context.get());
    }
    void refused(brume_status got, const std::string &part)
    {
        expect_status(context.get(), got, BRUME_ERROR_ARGUMENT, part);
    }

    Context context;
    brume_media media = nullptr;
    brume_camera camera = BRUME_CAMERA_INIT;
    brume_format format = BRUME_FORMAT_INIT;
    brume_media_view view = BRUME_MEDIA_VIEW_INIT;
};

}  // namespace

TEST_F(MediaAbi, GaussiansGoInAndOut)
{
    struct Wide {
        brume_gaussian gaussian;
        double newer;
    };
    std::vector<Wide> in(3, Wide{BRUME_GAUSSIAN_INIT, 0});
    for (size_t i = 0; i < in.size(); ++i) {
        in[i].gaussian.struct_size = sizeof(Wide);
        in[i].gaussian.center[1] = 0.1 * double(i);
        in[i].gaussian.color[2] = 0.5;
        in[i].gaussian.amplitude = double(i);
    }
    ASSERT_EQ(brume_media_put(media, &in[0].gaussian, 3), BRUME_OK) << message(context.get());
    const auto out = gaussians();
    ASSERT_EQ(out.size(), 3u);
    for (size_t i = 0; i < out.size(); ++i) {
        EXPECT_EQ(out[i].struct_size, sizeof(brume_gaussian));
        EXPECT_EQ(out[i].center[1], 0.1 * double(i));
        EXPECT_EQ(out[i].amplitude, double(i));
        EXPECT_EQ(out[i].color[2], 0.5);
    }
    std::vector<Wide> wide(2, Wide{BRUME_GAUSSIAN_INIT, 7});
    wide[0].gaussian.struct_size = sizeof(Wide);
    refused(brume_media_get_gaussians(media, 1, 2, &wide[0].gaussian), "struct_size");  // the 7 past the known end
    wide[0].newer = 0;
    ASSERT_EQ(brume_media_get_gaussians(media, 1, 2, &wide[0].gaussian), BRUME_OK) << message(context.get());
    EXPECT_EQ(wide[1].gaussian.amplitude, 2);
    EXPECT_EQ(wide[1].newer, 7);

    refused(brume_media_get_gaussians(media, 1, 3, &wide[0].gaussian), "there are 3 Gaussians");
    refused(brume_media_get_gaussians(media, UINT32_MAX, 2, &wide[0].gaussian), "there are 3 Gaussians");
    refused(brume_media_get_gaussians(media, 0, 1, nullptr), "out: NULL");
    in[1].gaussian.scale = 0;
    refused(brume_media_put(media, &in[0].gaussian, 3), "gaussians[1].scale: 0");
    refused(brume_media_put(media, nullptr, 3), "gaussians: NULL");
    EXPECT_EQ(info().gaussian_count, 3u);
    EXPECT_EQ(brume_media_put(media, nullptr, 0), BRUME_OK);
}

TEST_F(MediaAbi, SelectsWhatProjectsInside)
{
    put(10, 10, 2);    // the middle
    put(14, 10, 2);    // to the right: half of half the width
    put(10, 10, 4.5);  // above: half of half the height
    put(10, -10, 2);   // behind
    double upper[] = {30, 0, 50, 15};
    ASSERT_EQ(brume_media_select_rectangle(media, &view, upper, BRUME_MEDIA_SELECT_REPLACE), BRUME_OK)
        << message(context.get());
    uint8_t selected[4];
    ASSERT_EQ(brume_media_get_selection(media, 0, 4, selected), BRUME_OK);
    EXPECT_EQ(std::vector<uint8_t>(selected, selected + 4), (std::vector<uint8_t>{0, 0, 1, 0}));
    double right[] = {55, 19, 57, 21};
    ASSERT_EQ(brume_media_select_rectangle(media, &view, right, BRUME_MEDIA_SELECT_ADD), BRUME_OK);
    EXPECT_EQ(info().selected_count, 2u);
    // The same place in a crop of the picture.
    format.display_x = -40;
    format.display_width = 80;
    format.display_height = 40;
    format.width = 40;
    double cropped[] = {15, 19, 17, 21};
    ASSERT_EQ(brume_media_select_rectangle(media, &view, cropped, BRUME_MEDIA_SELECT_REMOVE), BRUME_OK);
    EXPECT_EQ(info().selected_count, 1u);

    refused(brume_media_select_rectangle(media, &view, right, 3), "mode: 3");
    refused(brume_media_select_rectangle(media, nullptr, right, 0), "brume_media_view: NULL");
    refused(brume_media_select_rectangle(media, &view, nullptr, 0), "rectangle: NULL");
    camera.given = BRUME_CAMERA_POSE;
    refused(brume_media_select_rectangle(media, &view, right, 0), "expected a field of view and a pose");
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    camera.camera_to_world[0] = 2;
    refused(brume_media_select_rectangle(media, &view, right, 0), "camera_to_world");
}

TEST_F(MediaAbi, StrokesLieOnTheirPlane)
{
    brume_media_stroke stroke = BRUME_MEDIA_STROKE_INIT;
    brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
    paint.stroke = &stroke;
    paint.jitter = 0;
    paint.spacing = 100;
    stroke.plane_normal[2] = -3;
    stroke.plane_point[2] = 0.5;
    const double world[] = {1, 2, 3, 4, 5, 6};
    stroke.points = world;
    stroke.point_count = 2;
    ASSERT_EQ(brume_media_apply_paint(media, &paint), BRUME_OK) << message(context.get());
    ASSERT_EQ(gaussians().size(), 1u);
    EXPECT_DOUBLE_EQ(gaussians()[0].center[0], 1);
    EXPECT_DOUBLE_EQ(gaussians()[0].center[1], 2);
    EXPECT_DOUBLE_EQ(gaussians()[0].center[2], 0.5);

    // The pixel's ray falls a quarter of the way that it goes, from a height of 1.5.
    const double screen[] = {60, 30};
    stroke.points = screen;
    stroke.point_count = 1;
    stroke.view = &view;
    ASSERT_EQ(brume_media_apply_paint(media, &paint), BRUME_OK) << message(context.get());
    ASSERT_EQ(gaussians().size(), 2u);
    EXPECT_NEAR(gaussians()[1].center[0], 10 + 0.5 * 6, 1e-5);
    EXPECT_NEAR(gaussians()[1].center[1], 6, 1e-5);
    EXPECT_NEAR(gaussians()[1].center[2], 0.5, 1e-5);

    const double sky[] = {60, 10};
    stroke.points = sky;
    refused(brume_media_apply_paint(media, &paint), "brume_media_stroke.points[0]: 60, 10; expected a pixel whose ray");
    stroke.plane_normal[2] = 0;
    refused(brume_media_apply_paint(media, &paint), "plane_normal: 0, 0, 0");
    stroke.view = nullptr;
    stroke.point_count = 0;
    refused(brume_media_apply_paint(media, &paint), "point_count: 0");
    stroke.point_count = 1;
    stroke.points = nullptr;
    refused(brume_media_apply_paint(media, &paint), "points: NULL");
    paint.stroke = nullptr;
    refused(brume_media_apply_paint(media, &paint), "brume_media_stroke: NULL");
    refused(brume_media_apply_paint(media, nullptr), "brume_media_paint: NULL");
}

// The airbrush before a wall, however its depth is given: no particle is behind it, and some would be without it.
TEST_F(MediaAbi, AirbrushReadsEveryKindOfDepth)
{
    brume_media_airbrush brush = BRUME_MEDIA_AIRBRUSH_INIT;
    brush.view = &view;
    brush.position[0] = 10, brush.position[1] = 3, brush.position[2] = 2;
    brush.velocity[1] = 2;
    brush.rate = 100;
    brush.duration = 3;
    const double wall = 4;
    std::vector<brume_gaussian> free;
    for (uint32_t kind = BRUME_DEPTH_PLANAR; kind <= BRUME_DEPTH_DEVICE; ++kind)
        for (const bool bottom_up : {false, true}) {
            format.depth_kind = kind;
            format.depth_range[0] = kind == BRUME_DEPTH_DEVICE ? 0.1 : 0;
            format.depth_range[1] = 100;
            Layout layout;
            layout.channels = 1;
            layout.bottom_up = bottom_up;
            Picture depth(80, 40, layout);
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 80; ++x) {
                    const double along = y < 2 ? 1e12 : wall, dx = (x + 0.5 - 40) / 40, dy = (y + 0.5 - 20) / 40;
                    const double values[] = {along, along * std::sqrt(1 + dx * dx + dy * dy), 1 / along,
                                             std::min(along / 100, 1.0), (10 - 1 / along) / (10 - 0.01)};
                    depth.set(x, y, 0, y < 2 && kind == BRUME_DEPTH_DEVICE ? 1.0f : float(values[kind]));
                }
            const brume_image image = depth.image();
            view.depth = &image;
            ASSERT_EQ(brume_media_apply_airbrush(media, &brush), BRUME_OK) << message(context.get());
            const auto made = gaussians();
            ASSERT_EQ(made.size(), 300u);
            size_t near_wall = 0;
            for (const brume_gaussian &g : made) {
                const double depth_of = g.center[1], up = (g.center[2] - 2) / depth_of,
                             right = (g.center[0] - 10) / depth_of;
                if (depth_of > 0 && std::abs(right) < 0.99 && up > -0.49 && up < 0.44) {
                    ASSERT_LE(depth_of, wall * 1.0001) << "kind " << kind;
                    near_wall += depth_of > 3.5;
                }
            }
            EXPECT_GT(near_wall, 10u) << "kind " << kind;
            ASSERT_EQ(brume_media_undo(media), BRUME_OK);
        }
    view.depth = nullptr;
    ASSERT_EQ(brume_media_apply_airbrush(media, &brush), BRUME_OK);
    size_t behind = 0;
    for (const brume_gaussian &g : gaussians())
        behind += g.center[1] > wall;
    EXPECT_GT(behind, 50u);
}

TEST_F(MediaAbi, DepthMustFit)
{
    brume_media_airbrush brush = BRUME_MEDIA_AIRBRUSH_INIT;
    brush.view = &view;
    Layout layout;
    layout.channels = 1;
    Picture depth(80, 39, layout);
    brume_image image = depth.image();
    view.depth = &image;
    expect_status(context.get(), brume_media_apply_airbrush(media, &brush), BRUME_ERROR_FORMAT, "80 x 39");
    image.data = nullptr;
    refused(brume_media_apply_airbrush(media, &brush), "brume_media_view.depth.data");
    image.kind = BRUME_IMAGE_GL_TEXTURE;
    image.gl_texture = 1;
    expect_status(context.get(), brume_media_apply_airbrush(media, &brush), BRUME_ERROR_UNSUPPORTED, "texture");
    brush.diffusion = NAN;
    view.depth = nullptr;
    refused(brume_media_apply_airbrush(media, &brush), "airbrush.diffusion: nan");
}

TEST_F(MediaAbi, EmitsErasesAndReplays)
{
    brume_media_emitter emitter = BRUME_MEDIA_EMITTER_INIT;
    emitter.seed = 3;
    emitter.spread = 0.2;
    ASSERT_EQ(brume_media_apply_emit(media, &emitter, 2.0), BRUME_OK) << message(context.get());
    EXPECT_NEAR(info().gaussian_count, 100, 2);
    refused(brume_media_apply_emit(media, &emitter, -1), "emit.time: -1");
    brume_media_stroke stroke = BRUME_MEDIA_STROKE_INIT;
    const double points[] = {0, 0, 0};
    stroke.points = points;
    stroke.point_count = 1;
    brume_media_erase erase = BRUME_MEDIA_ERASE_INIT;
    erase.stroke = &stroke;
    erase.radius = 0.5;
    erase.strength = 100;
    ASSERT_EQ(brume_media_apply_erase(media, &erase), BRUME_OK);
    EXPECT_LT(info().gaussian_count, 70u);
    ASSERT_EQ(brume_media_select_all(media), BRUME_OK);
    ASSERT_EQ(brume_media_copy(media), BRUME_OK);
    const double offset[] = {0, 5, 0};
    ASSERT_EQ(brume_media_paste(media, offset), BRUME_OK);
    ASSERT_EQ(brume_media_move(media, offset), BRUME_OK);
    EXPECT_EQ(info().clipboard_count * 2, info().gaussian_count);
    EXPECT_EQ(info().selected_count, info().clipboard_count);
    ASSERT_EQ(brume_media_delete(media), BRUME_OK);
    EXPECT_EQ(info().selected_count, 0u);
    ASSERT_EQ(brume_media_select_none(media), BRUME_OK);
    ASSERT_EQ(brume_media_undo(media), BRUME_OK);
    ASSERT_EQ(brume_media_undo(media), BRUME_OK);
    EXPECT_EQ(info().undo_count, 6u);
    EXPECT_EQ(info().redo_count, 2u);

    std::string journal(brume_media_journal(media, nullptr, 0), '\0');
    ASSERT_GT(journal.size(), 100u);
    brume_media_journal(media, journal.data(), journal.size());
    brume_media copy = nullptr;
    ASSERT_EQ(brume_media_create(context.get(), &copy), BRUME_OK);
    ASSERT_EQ(brume_media_replay(copy, journal.data(), journal.size() - 1, nullptr), BRUME_OK) << message(context.get());
    const auto mine = gaussians();
    std::swap(media, copy);
    const auto theirs = gaussians();
    ASSERT_EQ(mine.size(), theirs.size());
    EXPECT_EQ(std::memcmp(mine.data(), theirs.data(), mine.size() * sizeof mine[0]), 0);
    EXPECT_EQ(info().redo_count, 2u);
    ASSERT_EQ(brume_media_redo(media), BRUME_OK);
    ASSERT_EQ(brume_media_redo(media), BRUME_OK);
    refused(brume_media_redo(media), "nothing to redo");
    expect_status(context.get(), brume_media_replay(media, "{}", 2, "fog.journal"), BRUME_ERROR_SCENE,
                  "fog.journal:1:1: has no");
    brume_media_destroy(copy);
}

TEST_F(MediaAbi, FilesComeAndGo)
{
    const std::string path =
        (std::filesystem::temp_directory_path() / ("brume-media-" + std::to_string(::getpid()) + ".ply")).string();
    put(1, 2, 3);
    ASSERT_EQ(brume_media_save(media, path.c_str()), BRUME_OK) << message(context.get());
    ASSERT_EQ(brume_media_load(media, path.c_str()), BRUME_OK) << message(context.get());
    std::filesystem::remove(path);
    ASSERT_EQ(gaussians().size(), 2u);
    EXPECT_EQ(gaussians()[1].center[2], 3);
    EXPECT_EQ(info().undo_count, 2u);
    expect_status(context.get(), brume_media_load(media, path.c_str()), BRUME_ERROR_SCENE, "cannot be read");
    expect_status(context.get(), brume_media_save(media, "/nowhere/puffs.csv"), BRUME_ERROR_ARGUMENT, "/nowhere/puffs.csv");
    refused(brume_media_load(media, nullptr), "path: NULL");
    refused(brume_media_save(media, nullptr), "path: NULL");
}

TEST_F(MediaAbi, HandlesOfNothing)
{
    brume_media_destroy(nullptr);
    brume_media made = nullptr;
    expect_status(nullptr, brume_media_create(nullptr, &made), BRUME_ERROR_ARGUMENT, "context: NULL");
    refused(brume_media_create(context.get(), nullptr), "out: NULL");
    expect_status(nullptr, brume_media_undo(nullptr), BRUME_ERROR_ARGUMENT, "media: NULL");
    EXPECT_EQ(brume_media_journal(nullptr, nullptr, 0), 0u);
    refused(brume_media_move(media, nullptr), "offset: NULL");
    refused(brume_media_replay(media, nullptr, 1, nullptr), "text: NULL");
    // A medium keeps its context alive.
    context.reset();
    EXPECT_EQ(brume_media_select_all(media), BRUME_OK);
}
