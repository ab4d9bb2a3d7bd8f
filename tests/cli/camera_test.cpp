#include <cmath>
#include <numbers>

#include <ImfFloatAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "camera/block.hpp"
#include "exr/file.hpp"
#include "files.hpp"
#include "support/error.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;
using Imath::M44d;
using Imath::M44f;

constexpr double kDegree = std::numbers::pi / 180;

Imf::Header header_of(int width = 1920, int height = 1080)
{
    return Imf::Header(width, height);
}

/// World (right-handed) to the standard's camera at `place`, turned about y, looking along its own +z.
M44d world_to_camera(const Imath::V3d &place, double turn)
{
    M44d flip;
    flip[2][2] = -1;
    return M44d().setTranslation(-place) * M44d().setAxisAngle(Imath::V3d(0, 1, 0), -turn) * flip;
}

/// Camera to NDC of 0..1 with y down, for slopes of the window's edges; `forward` is the sign of z in view.
M44d camera_to_ndc(double left, double right, double bottom, double top, double forward = 1)
{
    // u = (x / z - left) / (right - left), v = (top - y / z) / (top - bottom)
    M44d m(0.0);
    m[0][0] = 1 / (right - left);
    m[2][0] = -forward * left / (right - left);
    m[1][1] = -1 / (top - bottom);
    m[2][1] = forward * top / (top - bottom);
    m[2][3] = forward;
    m[3][2] = 1;
    return m;
}

TEST(CameraMetadata, ReadsTheStandardMatrices)
{
    Imf::Header header = header_of();
    const double y = std::tan(25 * kDegree), x = y * 16 / 9;
    const M44d w2c = world_to_camera({3, 4, 5}, 0.3);
    Imf::addWorldToCamera(header, M44f(w2c));
    Imf::addWorldToNDC(header, M44f(w2c * camera_to_ndc(-x, x, -y, y)));
    const Camera camera = camera_from_metadata(part_of(header));
    ASSERT_TRUE(camera.projection && camera.pose);
    EXPECT_NEAR(camera.projection->vertical_fov(), 50 * kDegree, 1e-5);
    EXPECT_NEAR(camera.projection->center()[0], 0.5, 1e-5);
    EXPECT_NEAR(camera.projection->center()[1], 0.5, 1e-5);
    EXPECT_NEAR(camera.projection->pixel_aspect(part_of(header).display_window), 1, 1e-5);
    const Pose &pose = *camera.pose;
    EXPECT_NEAR(pose[3], 3, 1e-5);
    EXPECT_NEAR(pose[7], 4, 1e-5);
    EXPECT_NEAR(pose[11], 5, 1e-5);
    // Turned left by .3 about y, it looks along -(sin .3, 0, cos .3); the pose's third column points backward.
    EXPECT_NEAR(pose[2], std::sin(0.3), 1e-5);
    EXPECT_NEAR(pose[10], std::cos(0.3), 1e-5);
    EXPECT_NEAR(pose[5], 1, 1e-5);
}

TEST(CameraMetadata, KeepsOffAxisCentresAndAnamorphicPixels)
{
    Imf::Header header = header_of(1000, 1000);
    const M44d w2c = world_to_camera({0, 0, 0}, 0);
    Imf::addWorldToCamera(header, M44f(w2c));
    Imf::addWorldToNDC(header, M44f(w2c * camera_to_ndc(-0.5, 1.5, -0.25, 0.75)));
    const Camera camera = camera_from_metadata(part_of(header));
    ASSERT_TRUE(camera.projection);
    EXPECT_NEAR(camera.projection->center()[0], 0.25, 1e-5);
    EXPECT_NEAR(camera.projection->center()[1], 0.75, 1e-5);
    EXPECT_NEAR(camera.projection->pixel_aspect(part_of(header).display_window), 2, 1e-5);
    EXPECT_NEAR(camera.projection->vertical_fov(), 2 * std::atan(0.5), 1e-5);
}

TEST(CameraMetadata, UnderstandsCamerasThatLookAlongMinusZ)
{
    Imf::Header header = header_of(1000, 1000);
    const M44d w2c = M44d().setTranslation(Imath::V3d(-1, -2, -3));  // right-handed, as OpenGL has it
    Imf::addWorldToCamera(header, M44f(w2c));
    Imf::addWorldToNDC(header, M44f(w2c * camera_to_ndc(-1, 1, -1, 1, -1)));
    for (const bool with_ndc : {true, false}) {
        if (!with_ndc)
            header.erase("worldToNDC");
        const Camera camera = camera_from_metadata(part_of(header));
        ASSERT_TRUE(camera.pose);
        EXPECT_EQ(camera.projection.has_value(), with_ndc);
        EXPECT_NEAR((*camera.pose)[10], 1, 1e-6);
        EXPECT_NEAR((*camera.pose)[11], 3, 1e-6);
    }
}

TEST(CameraMetadata, UnderstandsOpenGLsClipSpaceWhereItStandsForNdc)
{
    Imf::Header header = header_of(1600, 800);
    const double y = std::tan(20 * kDegree), x = 2 * y;
    M44d clip(0.0);
    clip[0][0] = 1 / x;
    clip[1][1] = 1 / y;
    clip[2][2] = clip[2][3] = -1;
    clip[3][2] = -0.2;
    const M44d w2c = M44d().setTranslation(Imath::V3d(-1, -2, -3));
    Imf::addWorldToCamera(header, M44f(w2c));
    Imf::addWorldToNDC(header, M44f(w2c * clip));
    const Camera camera = camera_from_metadata(part_of(header));
    ASSERT_TRUE(camera.projection && camera.pose);
    EXPECT_NEAR(camera.projection->vertical_fov(), 40 * kDegree, 1e-5);
    EXPECT_NEAR(camera.projection->center()[0], 0.5, 1e-5);
    EXPECT_NEAR(camera.projection->center()[1], 0.5, 1e-5);
    EXPECT_NEAR(camera.projection->pixel_aspect(part_of(header).display_window), 1, 1e-5);
    EXPECT_NEAR((*camera.pose)[10], 1, 1e-6);
}

TEST(CameraMetadata, VRaysMatrixIsCameraToWorld)
{
    Imf::Header header = header_of(960, 540);
    M44f c2w;
    c2w.setTranslation(Imath::V3f(0, 5, 20));
    header.insert("cameraTransform", Imf::M44fAttribute(c2w));
    header.insert("cameraFov", Imf::FloatAttribute(54.4322f));
    const Camera camera = camera_from_metadata(part_of(header));
    ASSERT_TRUE(camera.projection && camera.pose);
    EXPECT_NEAR((*camera.pose)[7], 5, 1e-6);
    EXPECT_NEAR((*camera.pose)[11], 20, 1e-6);
    EXPECT_NEAR(camera.projection->vertical_fov(), 2 * std::atan(std::tan(27.2161 * kDegree) * 9 / 16), 1e-6);
    header.erase("cameraFov");
    header.insert("cameraAperture", Imf::FloatAttribute(36));
    header.insert("cameraFocalLength", Imf::FloatAttribute(35));
    EXPECT_NEAR(camera_from_metadata(part_of(header)).projection->vertical_fov(), camera.projection->vertical_fov(), 1e-5);
}

/// Mantra's: the camera looks along its +z, and the NDC has the signs of one that looks along -z.
TEST(CameraMetadata, UnderstandsMantrasMirroredMatrices)
{
    Imf::Header header = header_of(1600, 800);
    const double y = std::tan(20 * kDegree), x = 2 * y;
    M44d ndc(0.0);
    ndc[0][0] = 1 / x;
    ndc[1][1] = 1 / y;
    ndc[2][2] = ndc[2][3] = -1;
    ndc[3][2] = -0.001;
    const M44d w2c = world_to_camera({1, 2, 3}, 0.4);
    Imf::addWorldToCamera(header, M44f(w2c));
    Imf::addWorldToNDC(header, M44f(w2c * ndc));
    const Camera camera = camera_from_metadata(part_of(header));
    ASSERT_TRUE(camera.projection && camera.pose);
    EXPECT_TRUE(camera.notes.empty()) << camera.notes_text();
    EXPECT_EQ(rigid_defect(*camera.pose), "");
    EXPECT_NEAR(camera.projection->vertical_fov(), 40 * kDegree, 1e-5);
    EXPECT_NEAR((*camera.pose)[2], std::sin(0.4), 1e-5);
    EXPECT_NEAR((*camera.pose)[3], 1, 1e-5);
}

/// pbrt's: for column vectors, y up, 0..1 over the shorter side, in a left-handed world.
TEST(CameraMetadata, UnderstandsPbrtsMatrices)
{
    for (const bool portrait : {false, true})
        for (const double turn : {0.0, 0.7})
            for (const double away : {0.0, 5.0}) {
                Imf::Header header = portrait ? header_of(36, 64) : header_of(64, 36);
                const double s = 0.5 / std::tan(22.5 * kDegree);
                M44d camera_to_ndc(0.0);  // rows, transposed below
                camera_to_ndc[0][0] = camera_to_ndc[1][1] = s;
                camera_to_ndc[2][0] = camera_to_ndc[2][1] = 0.5;
                camera_to_ndc[2][2] = camera_to_ndc[2][3] = 1;
                camera_to_ndc[3][2] = -0.005;
                const M44d w2c =
                    M44d().setAxisAngle(Imath::V3d(0, 1, 0), turn) * M44d().setTranslation(Imath::V3d(0, 0, away));
                Imf::addWorldToCamera(header, M44f(w2c.transposed()));
                Imf::addWorldToNDC(header, M44f((w2c * camera_to_ndc).transposed()));
                const Camera camera = camera_from_metadata(part_of(header));
                ASSERT_TRUE(camera.projection) << camera.notes_text();
                const double vertical = portrait ? 2 * std::atan(std::tan(22.5 * kDegree) * 64 / 36) : 45 * kDegree;
                EXPECT_NEAR(camera.projection->vertical_fov(), vertical, 1e-4) << turn << ' ' << away;
                EXPECT_NEAR(camera.projection->pixel_aspect(part_of(header).display_window), 1, 1e-4);
                EXPECT_NEAR(camera.projection->center()[1], 0.5, 1e-4);
                EXPECT_FALSE(camera.pose);
                EXPECT_NE(camera.notes_text().find("left-handed"), std::string::npos) << camera.notes_text();
            }
}

TEST(CameraMetadata, RefusesWhatNoCameraHasUnlessItIsNamed)
{
    for (const double degrees : {0.5, 175.0}) {
        Imf::Header header = header_of(1000, 1000);
        header.insert("cameraFov", Imf::FloatAttribute(float(degrees)));
        const Camera camera = camera_from_metadata(part_of(header));
        EXPECT_FALSE(camera.projection);
        EXPECT_NE(camera.notes_text().find("expected 1 to 170"), std::string::npos) << camera.notes_text();
        EXPECT_NEAR(camera_from_metadata(part_of(header), Implausible::kTaken).projection->vertical_fov(), degrees * kDegree,
                    1e-5);
    }
    Imf::Header header = header_of(1000, 1000);
    M44f w2c;
    w2c[3][3] = 2;
    Imf::addWorldToCamera(header, w2c);
    EXPECT_NE(camera_from_metadata(part_of(header)).notes_text().find("expected 0 0 0 1"), std::string::npos);
    M44f sheared;
    sheared[0][1] = 0.5;
    header.insert("worldToCamera", Imf::M44fAttribute(sheared));
    EXPECT_FALSE(camera_from_metadata(part_of(header)).pose);
}

TEST(CameraMetadata, IgnoresNonsense)
{
    Imf::Header header = header_of();
    Imf::addWorldToCamera(header, M44f(0.0f));
    header.insert("cameraFov", Imf::FloatAttribute(0));
    const Camera camera = camera_from_metadata(part_of(header));
    EXPECT_FALSE(camera.projection || camera.pose);
    EXPECT_EQ(camera.notes.size(), 2u);
}

TEST(CameraFile, ReadsTheSceneFilesBlock)
{
    const Folder folder;
    write_text(folder / "c.json",
               R"({"camera":{"horizontal_fov":90,"camera_to_world":[[1,0,0,7],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}})");
    const Camera camera = camera_from_file(folder / "c.json", part_of(header_of(1600, 800)));
    EXPECT_NEAR(camera.projection->vertical_fov(), 2 * std::atan(0.5), 1e-9);
    EXPECT_EQ((*camera.pose)[3], 7);
    write_text(folder / "k.json", R"({"vertical_fov":{"keys":[[1,40],[3,60]]},"pixel_aspect":2,"center":[0.25,0.5]})");
    const Camera keyed = camera_from_file(folder / "k.json", part_of(header_of(1000, 1000)), "", 2);
    EXPECT_NEAR(keyed.projection->vertical_fov(), 50 * kDegree, 1e-9);
    EXPECT_NEAR(keyed.projection->pixel_aspect(part_of(header_of(1000, 1000)).display_window), 2, 1e-9);
    EXPECT_NEAR(keyed.projection->center()[0], 0.25, 1e-9);
    for (const char *text : {"{\"vertical_fow\":50}", "{\"vertical_fov\":50,\"centre\":[0,0]}",
                             "{\"camera_to_world\":[[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]}", "{}", "[1]",
                             "{\"vertical_fov\":180}", "{\"camera_to_world\":[1,2]}", "{"}) {
        write_text(folder / "bad.json", text);
        EXPECT_THROW(camera_from_file(folder / "bad.json", part_of(header_of())), RequestError) << text;
    }
}

}  // namespace
}  // namespace brume::tests
