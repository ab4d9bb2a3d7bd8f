// Histories of media: selections, undoing, and journals that replay to the same bits.
#include "media/random.h"
#include "media_operations.h"

namespace brume::media {
namespace {

size_t selected(const History &history)
{
    return size_t(std::count(history.state().selected.begin(), history.state().selected.end(), 1));
}

TEST(MediaSelection, SelectsCopiesMovesDeletes)
{
    History history;
    history.apply(grid());
    SelectRectangle select;
    select.lens = lens();
    // At depth 4 a unit is 8 pixels: the upper right quarter, axes included.
    select.rectangle = {31, 0, 64, 25};
    history.apply(select);
    EXPECT_EQ(selected(history), 16u);
    for (size_t i = 0; i < history.state().gaussians.size(); ++i) {
        const dvec3 at = center(history.state().gaussians[i]);
        EXPECT_EQ(bool(history.state().selected[i]), at.z < 0 && at.x >= 0 && at.y >= 0);
    }
    select.mode = BRUME_MEDIA_SELECT_ADD;
    select.rectangle = {0, 0, 33, 25};
    history.apply(select);
    EXPECT_EQ(selected(history), 28u);
    select.mode = BRUME_MEDIA_SELECT_REMOVE;
    history.apply(select);
    EXPECT_EQ(selected(history), 12u);

    history.apply(Copy{});
    EXPECT_EQ(history.state().clipboard.size(), 12u);
    Move move;
    move.offset = {0, 0, -1};
    history.apply(move);
    for (size_t i = 0; i < history.state().gaussians.size(); ++i)
        EXPECT_EQ(history.state().gaussians[i].center[2] == -5, bool(history.state().selected[i]));
    Paste paste;
    paste.offset = {10, 0, 0};
    history.apply(paste);
    EXPECT_EQ(history.state().gaussians.size(), 62u);
    EXPECT_EQ(selected(history), 12u);
    for (size_t i = 50; i < 62; ++i) {
        EXPECT_TRUE(history.state().selected[i]);
        EXPECT_EQ(history.state().gaussians[i].center[2], -4);
        EXPECT_GE(history.state().gaussians[i].center[0], 10);
    }
    history.apply(Delete{});
    EXPECT_EQ(history.state().gaussians.size(), 50u);
    EXPECT_EQ(selected(history), 0u);
    history.apply(SelectAll{});
    EXPECT_EQ(selected(history), 50u);
    history.apply(SelectNone{});
    EXPECT_EQ(selected(history), 0u);
}

// One of everything, with numbers that have no short decimals.
std::vector<Operation> everything()
{
    Put put = grid();
    put.gaussians[0].center = {-0.0, 1.0 / 3, 1e-300 * 0 + std::numbers::pi};
    put.gaussians[1].color = {0.1f, 1.0f / 3, 0};
    Erase erase;
    erase.points = {{0.1, 0.2, -4}, {1.0 / 7, -2, -4}};
    erase.radius = 1.1;
    erase.strength = 0.7;
    Emit emit = steam();
    emit.spread = 1.0 / 3;
    emit.time = 4.2;
    SelectRectangle select;
    select.lens = lens();
    select.lens.tangent_scale *= 1 + 1e-15;
    select.rectangle = {10.1, 0, 64, 25};
    Paste paste;
    paste.offset = {0.1, -0.0, 3};
    Move move;
    move.offset = {1e-17, 1.0 / 3, 0};
    Airbrush again = airbrush();
    again.seed = 10;
    Airbrush free = airbrush();
    free.depth = nullptr;
    auto shared = airbrush();
    again.depth = shared.depth;
    return {put,    stroke({{0, 0, 0}, {1.0 / 3, 2, 3}, {4, 5, 6}}),
            erase,  emit,
            select, Copy{},
            paste,  move,
            shared, again,
            free,   SelectAll{},
            Copy{}, SelectNone{},
            select, Delete{}};
}

TEST(MediaHistory, UndoesAndRedoes)
{
    History history;
    std::vector<State> states{history.state()};
    for (const Operation &operation : everything()) {
        history.apply(operation);
        states.push_back(history.state());
    }
    const size_t count = states.size() - 1;
    EXPECT_EQ(history.undo_count(), count);
    EXPECT_NE(failure([&] { history.redo(); }).find("nothing to redo"), std::string::npos);
    for (size_t i = count; i-- > 0;) {
        history.undo();
        expect_same(history.state(), states[i]);
        EXPECT_EQ(history.redo_count(), count - i);
    }
    EXPECT_NE(failure([&] { history.undo(); }).find("nothing to undo"), std::string::npos);
    for (size_t i = 1; i <= count; ++i) {
        history.redo();
        expect_same(history.state(), states[i]);
    }
    // A new operation ends what could be redone.
    history.undo();
    history.undo();
    history.apply(SelectAll{});
    EXPECT_EQ(history.redo_count(), 0u);
    EXPECT_EQ(history.undo_count(), count - 1);
}

TEST(MediaHistory, ForgottenStatesComeBack)
{
    History history;
    Put put;
    put.gaussians.resize(400000);
    history.apply(put);
    Move move;
    move.offset = {0.1, 0, 0};
    history.apply(SelectAll{});
    for (int i = 0; i < 14; ++i)
        history.apply(move);
    const State last = history.state();
    for (int i = 0; i < 14; ++i)
        history.undo();
    EXPECT_EQ(history.state().gaussians[0].center[0], 0);
    EXPECT_EQ(history.state().gaussians.size(), 400000u);
    for (int i = 0; i < 14; ++i)
        history.redo();
    expect_same(history.state(), last);
}

TEST(MediaHistory, AFailureChangesNothing)
{
    History history;
    history.apply(stroke({{0, 0, 0}, {3, 0, 0}}));
    const State before = history.state();
    EXPECT_EQ(failure([&] {
                  Paint paint = stroke({{0, 0, 0}});
                  paint.scale = 0;
                  history.apply(paint);
              }),
              "paint.scale: 0; expected a number from 1e-30 to 1e+30");
    EXPECT_EQ(failure([&] {
                  Paint paint = stroke({{0, 0, 0}});
                  paint.color[2] = -0.5;
                  history.apply(paint);
              }),
              "paint.color[2]: -0.5; expected a number from 0 to 1");
    EXPECT_EQ(failure([&] { history.apply(stroke({})); }), "paint.points: 0 of them; expected 1 to 65536");
    EXPECT_NE(failure([&] {
                  history.apply(stroke({{0, 0, 0}, {NAN, 0, 0}}));
              }).find("paint.points[1][0]: nan"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  history.apply(stroke({{0, 0, 0}, {1e9, 0, 0}}));
              }).find("expected 1000000 at most"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Emit emit = steam();
                  emit.rate = 1e9;
                  emit.time = 1e6;
                  history.apply(emit);
              }).find("emit: makes"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Emit emit = steam();
                  emit.velocity = {1e30, 0, 0};
                  emit.time = 3;
                  history.apply(emit);
              }).find("emit.center[0]"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Airbrush brush = airbrush();
                  brush.rate = 1e3;
                  brush.duration = 900;
                  history.apply(brush);
              }).find("steps; expected"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Airbrush brush = airbrush();
                  brush.position = {0, 0, -3.5};
                  history.apply(brush);
              }).find("airbrush.position: 0, 0, -3.5; expected a place before"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  SelectRectangle select;
                  select.mode = 3;
                  history.apply(select);
              }).find("select_rectangle.mode: 3"),
              std::string::npos);
    EXPECT_NE(failure([&] {
                  Erase erase;
                  erase.points.resize(65536);
                  Put put;
                  put.gaussians.resize(100000);
                  History large;
                  large.apply(put);
                  large.apply(erase);
              }).find("erase.points: 65536 of them over 100000"),
              std::string::npos);
    expect_same(history.state(), before);
    EXPECT_EQ(history.undo_count(), 1u);
}

TEST(MediaJournal, ReplaysToTheSameBits)
{
    History history;
    for (const Operation &operation : everything())
        history.apply(operation);
    for (int i = 0; i < 3; ++i)
        history.undo();
    const std::string text = journal_of(history);
    // The header, the room's depth once, the operations, the undos.
    EXPECT_EQ(size_t(std::count(text.begin(), text.end(), '\n')), 1 + 1 + everything().size() + 3);
    EXPECT_NE(text.find("\"colour\":[1,0.5,0.25]"), std::string::npos) << "the key that journals of 0.1 have";
    History copy;
    replay(copy, text, "journal");
    expect_same(copy.state(), history.state());
    EXPECT_EQ(copy.redo_count(), 3u);
    EXPECT_EQ(journal_of(copy), text);
    for (int i = 0; i < 3; ++i) {
        copy.redo();
        history.redo();
        expect_same(copy.state(), history.state());
    }
    // CRLF, blank lines, and no newline at the end.
    std::string typed;
    for (const char c : text.substr(0, text.size() - 1))
        typed += c == '\n' ? std::string("\r\n \n") : std::string(1, c);
    History again;
    replay(again, typed, "journal");
    EXPECT_EQ(journal_of(again), text);
}

TEST(MediaJournal, SaysWhatIsWrongAndWhere)
{
    const std::string header = "{\"brume_journal\": 1}\n";
    const auto says = [](const std::string &text) {
        History history;
        history.apply(SelectAll{});
        const std::string message = failure([&] { replay(history, text, "fog.journal"); }, BRUME_ERROR_SCENE);
        EXPECT_EQ(history.undo_count(), 1u);
        return message;
    };
    EXPECT_EQ(says(""), "fog.journal: empty; expected a line {\"brume_journal\": 1}");
    EXPECT_NE(says("{\"brume\": 1}\n").find("fog.journal:1:2: unknown key \"brume\""), std::string::npos);
    EXPECT_NE(says("{\"brume_journal\": 2}\n").find("fog.journal:1:"), std::string::npos);
    EXPECT_NE(says(header + "paint\n").find("fog.journal:2:1: syntax error"), std::string::npos);
    EXPECT_NE(says(header + "\n[]\n").find("fog.journal:3:1: an array of 0; expected an object"), std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"smear\"}\n").find("\"smear\"; expected one of put, paint, erase"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"erase\"}\n").find("has no \"points\""), std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"move\", \"offset\": [1, 2]}\n").find("an array of 3 numbers"), std::string::npos);
    EXPECT_NE(
        says(header + "{\"op\": \"move\", \"offset\": [1, 2, 1e40]}\n").find("offset[2]: 1e+40; expected a number from"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"move\", \"offset\": [1, 2, 3], \"by\": 1}\n").find("unknown key \"by\""),
              std::string::npos);
    EXPECT_NE(
        says(header + "{\"op\": \"erase\", \"points\": [], \"radius\": 1, \"strength\": 1}\n").find("1 to 65536 points"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"put\", \"gaussians\": \"x,y,z,scale,amplitude\\n1,2,3,0,1\"}\n")
                  .find("fog.journal:2: gaussians:2: scale: 0; expected"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"redo\"}\n").find("fog.journal:2: redo: there is nothing to redo"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"op\": \"undo\"}\n{\"op\": \"undo\"}\n").find("fog.journal:3: undo: there is nothing"),
              std::string::npos);
    EXPECT_NE(says(header + "{\"depth\": 2, \"width\": 1, \"height\": 1, \"data\": \"AAAAAA==\"}\n").find("expected 1"),
              std::string::npos);
    EXPECT_NE(
        says(header + "{\"depth\": 1, \"width\": 2, \"height\": 1, \"data\": \"AAAAAA==\"}\n").find("base64 of 2 floats"),
        std::string::npos);
    EXPECT_NE(says(header + "{\"depth\": 1, \"width\": 65536, \"height\": 65536, \"data\": \"\"}\n").find("base64 of"),
              std::string::npos);
}

// Damaged journals end in a message or in a state that could be saved.
TEST(MediaJournal, SurvivesDamage)
{
    History history;
    for (const Operation &operation : everything())
        if (!std::holds_alternative<Airbrush>(operation))
            history.apply(operation);
    const std::string whole = journal_of(history);
    size_t accepted = 0, refused = 0;
    for (uint64_t i = 0; i < 600; ++i) {
        Random random(2, i);
        std::string text = whole;
        for (int hits = 1 + int(random.next() * 2); hits > 0; --hits)
            text[size_t(random.next() * double(text.size()))] = "0123456789-eE.,:{}[]\"\n"[size_t(random.next() * 22)];
        History damaged;
        try {
            replay(damaged, text, "damaged");
            ++accepted;
        } catch (const Error &error) {
            EXPECT_EQ(std::string(error.what()).substr(0, 7), "damaged");
            EXPECT_EQ(damaged.undo_count(), 0u);
            ++refused;
        }
    }
    EXPECT_GT(accepted, 20u);
    EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace brume::media
