/* The library as a host loads it at run time: opened and closed again and again, by a relative path, without its effects.
 * loading CASE DIRECTORY; the DIRECTORY has what CMakeLists.txt puts there. */
#include <dirent.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <brume/brume.h>

#define SIZE 256

static void fail(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why ? why : "");
    exit(1);
}

#define EACH_FUNCTION(F)                                                                                                  \
    F(brume_context_create)                                                                                               \
    F(brume_context_destroy)                                                                                              \
    F(brume_effect_get_info)                                                                                              \
    F(brume_message)                                                                                                      \
    F(brume_plan_create)                                                                                                  \
    F(brume_plan_destroy)                                                                                                 \
    F(brume_plan_execute)                                                                                                 \
    F(brume_scene_create_from_text)                                                                                       \
    F(brume_scene_destroy)

typedef struct Library {
    void *handle;
#define MEMBER(name) __typeof__(&name) name;
    EACH_FUNCTION(MEMBER)
} Library;

static Library load(const char *path)
{
    Library library;
    void *address;
    library.handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library.handle)
        fail(path, dlerror());
#define FIND(name)                                                                                                        \
    address = dlsym(library.handle, #name);                                                                               \
    if (!address)                                                                                                         \
        fail(#name, "not exported");                                                                                      \
    memcpy(&library.name, &address, sizeof address);
    EACH_FUNCTION(FIND)
    return library;
}

static void check(const Library *library, brume_context context, brume_status status, const char *what)
{
    char message[2048];
    if (status == BRUME_OK)
        return;
    library->brume_message(context, message, sizeof message);
    fail(what, message);
}

static brume_context make_context(const Library *library)
{
    brume_context context;
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    check(library, NULL, library->brume_context_create(&desc, &context), "brume_context_create");
    return context;
}

static brume_scene make_scene(const Library *library, brume_context context, const char *text)
{
    brume_scene scene;
    check(library, context, library->brume_scene_create_from_text(context, text, strlen(text), NULL, &scene),
          "brume_scene_create_from_text");
    return scene;
}

static brume_status make_plan(const Library *library, brume_scene scene, brume_plan *plan)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = format.height = SIZE;
    format.depth_kind = BRUME_DEPTH_RAY;
    return library->brume_plan_create(scene, &format, plan);
}

static const char fog[] = "{\"brume\": 1, \"camera\": {\"vertical_fov\": 50}, \"medium\": {\"visibility\": 100}}";

/* A frame through everything, and a call that fails, for what the thread keeps of it. */
static void *use(void *given)
{
    const Library *library = given;
    brume_context context = make_context(library);
    brume_scene scene = make_scene(library, context, fog), none;
    brume_plan plan;
    brume_image color = BRUME_IMAGE_INIT, depth;
    brume_frame frame = BRUME_FRAME_INIT;
    float *rgba = calloc(SIZE * SIZE * 4, sizeof *rgba), *distances = calloc(SIZE * SIZE, sizeof *distances);
    int i;
    if (!rgba || !distances)
        fail("calloc", "no memory");
    for (i = 0; i < SIZE * SIZE; ++i)
        distances[i] = 50;
    check(library, context, make_plan(library, scene, &plan), "brume_plan_create");
    color.width = color.height = SIZE;
    color.data = rgba;
    depth = color;
    depth.channels = 1;
    depth.data = distances;
    frame.color = frame.output = &color;
    frame.depth = &depth;
    check(library, context, library->brume_plan_execute(plan, &frame), "brume_plan_execute");
    library->brume_scene_create_from_text(context, "{", 1, NULL, &none);
    library->brume_plan_destroy(plan);
    library->brume_scene_destroy(scene);
    library->brume_context_destroy(context);
    free(rgba);
    free(distances);
    return NULL;
}

static void sleep_ms(long ms)
{
    struct timespec time;
    time.tv_sec = ms / 1000;
    time.tv_nsec = ms % 1000 * 1000000;
    nanosleep(&time, NULL);
}

/* Whatever still runs when the library is closed crashes within the second that the host lives on. */
static void closes(void)
{
    int i;
    for (i = 0; i < 50; ++i) {
        Library library = load("lib/libbrume.so");
        pthread_t thread;
        if (pthread_create(&thread, NULL, use, &library))
            fail("pthread_create", "failed");
        pthread_join(thread, NULL);
        if (dlclose(library.handle))
            fail("dlclose", dlerror());
    }
    sleep_ms(1000);
}

/* The host moves to a directory in which another lib/brume/ lies in wait. */
static void moves(const char *directory)
{
    char expected[4096];
    Library library = load("./lib/libbrume.so");
    brume_context context;
    brume_effect_info info = BRUME_EFFECT_INFO_INIT;
    uint32_t i;
    if (chdir("elsewhere"))
        fail("chdir", "elsewhere");
    context = make_context(&library);
    snprintf(expected, sizeof expected, "%s/lib/brume/multiscatter.so", directory);
    for (i = 0; library.brume_effect_get_info(context, i, &info) == BRUME_OK; ++i)
        if (strcmp(info.file, expected) != 0)
            fail(info.file, "loaded; expected multiscatter.so of the library's own directory alone");
    if (i != 1)
        fail(expected, "not found");
    library.brume_context_destroy(context);
    use(&library);
}

static void expect_no_plan(const Library *library, brume_context context, const char *text, const char *const *parts)
{
    char message[4096];
    brume_scene scene = make_scene(library, context, text);
    brume_plan plan;
    if (make_plan(library, scene, &plan) != BRUME_ERROR_NOT_FOUND)
        fail(text, "expected BRUME_ERROR_NOT_FOUND of brume_plan_create");
    library->brume_message(context, message, sizeof message);
    for (; *parts; ++parts)
        if (!strstr(message, *parts)) {
            fprintf(stderr, "no \"%s\" in \"%s\"\n", *parts, message);
            exit(1);
        }
    library->brume_scene_destroy(scene);
}

static void expect_plan(const Library *library, brume_context context, const char *text)
{
    brume_scene scene = make_scene(library, context, text);
    brume_plan plan;
    check(library, context, make_plan(library, scene, &plan), text);
    library->brume_plan_destroy(plan);
    library->brume_scene_destroy(scene);
}

/* A medium that nothing renders is no fog without a word; what asks for none is not held up. */
static void misses_effects(const char *directory)
{
    char searched[4096];
    const char *parts[] = {"medium", searched, NULL};
    Library library = load("lost/libbrume.so");
    brume_context context = make_context(&library);
    snprintf(searched, sizeof searched, "%s/lost/brume", directory);
    expect_no_plan(&library, context, fog, parts);
    expect_no_plan(&library, context, "{\"brume\": 1, \"medium\": {\"emission\": 1}}", parts);
    expect_plan(&library, context, "{\"brume\": 1}");
    expect_plan(&library, context, "{\"brume\": 1, \"medium\": {}}");
    library.brume_context_destroy(context);
}

static void has_broken_effect(const char *directory)
{
    char file[4096];
    const char *parts[] = {file, "refused", NULL};
    Library library = load("broken/libbrume.so");
    brume_context context = make_context(&library);
    snprintf(file, sizeof file, "%s/broken/brume/multiscatter.so", directory);
    expect_no_plan(&library, context, fog, parts);
    library.brume_context_destroy(context);
}

static const char lamp[] = "{\"brume\": 1, \"medium\": {\"scattering\": 0.1}, \"lights\": [{\"type\": \"point\", "
                           "\"position\": [0, 0, -5], \"intensity\": 9}]}";

/* Nor are lights that nothing renders dark without a word. */
static void misses_airlight(const char *directory)
{
    char searched[4096];
    const char *of_lights[] = {"lights: no effect", searched, NULL}, *of_environment[] = {"environment: no effect", searched, NULL};
    Library library = load("lib/libbrume.so");
    brume_context context = make_context(&library);
    snprintf(searched, sizeof searched, "%s/lib/brume", directory);
    expect_no_plan(&library, context, lamp, of_lights);
    expect_no_plan(&library, context,
                   "{\"brume\": 1, \"medium\": {\"visibility\": 100}, \"environment\": {\"sh\": [[1, 1, 1]]}}",
                   of_environment);
    expect_plan(&library, context, fog);
    expect_plan(&library, context,
                "{\"brume\": 1, \"medium\": {\"absorption\": 0.1}, \"environment\": {\"sh\": [[1, 1, 1]]}}");
    expect_plan(&library, context,
                "{\"brume\": 1, \"medium\": {\"scattering\": 0.1}, \"environment\": {\"sh\": [[1, 1, 1]]}, "
                "\"effects\": {\"multiscatter\": {}}}");
    library.brume_context_destroy(context);
}

static void has_broken_airlight(const char *directory)
{
    char file[4096];
    const char *parts[] = {"lights: no effect", file, "refused", NULL};
    Library library = load("dim/libbrume.so");
    brume_context context = make_context(&library);
    snprintf(file, sizeof file, "%s/dim/brume/airlight.so", directory);
    expect_no_plan(&library, context, lamp, parts);
    library.brume_context_destroy(context);
}

int main(int argc, char **argv)
{
    char directory[4000];
    if (argc != 3 || chdir(argv[2]) || !getcwd(directory, sizeof directory))
        fail("loading", "expected CASE DIRECTORY");
    if (strcmp(argv[1], "closes") == 0)
        closes();
    else if (strcmp(argv[1], "moves") == 0)
        moves(directory);
    else if (strcmp(argv[1], "misses_effects") == 0)
        misses_effects(directory);
    else if (strcmp(argv[1], "has_broken_effect") == 0)
        has_broken_effect(directory);
    else if (strcmp(argv[1], "misses_airlight") == 0)
        misses_airlight(directory);
    else if (strcmp(argv[1], "has_broken_airlight") == 0)
        has_broken_airlight(directory);
    else
        fail(argv[1], "no such case");
    return 0;
}
