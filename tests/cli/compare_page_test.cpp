#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <half.h>
#include <zlib.h>

#include "files.hpp"

namespace brume::tests {
namespace {

class ComparePage : public testing::Test {
protected:
    ComparePage()
    {
        TestPart part{rgb("", Imf::FLOAT)};
        part.data = {{2, 1}, {9, 6}};
        write_exr(folder_ / "gold.exr", {part});
        part.channels[0].value = [](int x, int y) { return x == 4 && y == 3 ? NAN : x == 3 && y == 1 ? 1e6 : 0.5; };
        write_exr(folder_ / "<&new\">.exr", {part});
        const Result r = brume({"compare", (folder_ / "<&new\">.exr").string(), (folder_ / "gold.exr").string(), "--fail",
                                "0.1", "--html", (folder_ / "pages").string()});
        status_ = r.status;
        index_ = read_text(folder_ / "pages/index.html");
        page_ = read_text(page_path());
    }
    fs::path page_path() const { return folder_ / "pages/_3c_26new_22_3e.exr.html"; }

    /// The text of the element with this id.
    std::string text_of(const std::string &id) const
    {
        const auto at = page_.find('>', page_.find("id=\"" + id + "\"")) + 1;
        return page_.substr(at, page_.find('<', at) - at);
    }

    static std::vector<unsigned char> from_base64(const std::string &text)
    {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::vector<unsigned char> bytes;
        unsigned bits = 0, count = 0;
        for (const char c : text) {
            if (c == '=')
                break;
            const auto digit = digits.find(c);
            EXPECT_NE(digit, std::string::npos) << "'" << c << "'";
            bits = bits << 6 | unsigned(digit);
            if ((count += 6) >= 8)
                bytes.push_back((unsigned char)(bits >> (count -= 8)));
        }
        return bytes;
    }

    /// Channel by channel, as the page's script has it.
    std::vector<float> picture(const std::string &id, std::size_t values) const
    {
        const auto packed = from_base64(text_of(id));
        std::vector<unsigned char> bytes(2 * values + 1);
        uLongf size = uLongf(bytes.size());
        EXPECT_EQ(::uncompress(bytes.data(), &size, packed.data(), uLong(packed.size())), Z_OK);
        EXPECT_EQ(size, 2 * values);
        std::vector<float> out;
        for (std::size_t i = 0; i < values; ++i) {
            half h;
            h.setBits((unsigned short)(bytes[i] << 8 | bytes[i + values]));
            out.push_back(h);
        }
        return out;
    }

    Folder folder_;
    int status_ = 0;
    std::string index_, page_;
};

/// Every element that is opened is closed, in order; what stands in scripts and styles is no markup.
std::string unbalanced(const std::string &html)
{
    std::vector<std::string> open;
    const std::regex tag("<(/?)([a-z0-9]+)([^<>]*?)(/?)>");
    for (std::size_t at = 0; (at = html.find('<', at)) != std::string::npos;) {
        std::smatch m;
        const std::string rest = html.substr(at, html.find('>', at) + 1 - at);
        if (rest.starts_with("<!DOCTYPE")) {
            at += rest.size();
            continue;
        }
        if (!std::regex_match(rest, m, tag))
            return "no tag: " + rest.substr(0, 80);
        at += rest.size();
        if (m[4] == "/")
            continue;
        if (m[1] != "/") {
            open.push_back(m[2]);
            if (m[2] == "script" || m[2] == "style")
                at = html.find("</" + m[2].str() + ">", at);
            continue;
        }
        if (open.empty() || open.back() != m[2])
            return "closed but not open: " + m[2].str();
        open.pop_back();
    }
    return open.empty() ? "" : "left open: " + open.back();
}

TEST_F(ComparePage, IsWellFormedAndNeedsNoOtherFile)
{
    EXPECT_EQ(status_, 1);
    EXPECT_EQ(unbalanced(page_), "");
    EXPECT_EQ(unbalanced(index_), "");
    EXPECT_NE(unbalanced("<p><b></p></b>"), "");
    EXPECT_NE(unbalanced("<p>"), "");
    for (const char *outside : {"http:", "https:", "src=", "href=", "@import", "url("})
        EXPECT_EQ(page_.find(outside), std::string::npos) << outside;
    EXPECT_NE(index_.find("href=\"_3c_26new_22_3e.exr.html\""), std::string::npos) << index_;
    EXPECT_NE(page_.find("<title>&lt;&amp;new&quot;&gt;.exr</title>"), std::string::npos);
    EXPECT_NE(page_.find("<th>HDR-FLIP</th>"), std::string::npos);
    EXPECT_NE(page_.find("class=\"beyond\""), std::string::npos);
}

TEST_F(ComparePage, HoldsBothPicturesAndTheirDifference)
{
    const std::size_t count = 8 * 6;
    const auto a = picture("a-data", 3 * count), b = picture("b-data", 3 * count), d = picture("difference-data", 3 * count);
    const auto green = read_plane(folder_ / "gold.exr", "G");
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(b[count + i], float(half(float(green[i])))) << i;
        EXPECT_EQ(a[count + i], b[count + i]);
        EXPECT_EQ(d[count + i], 0);
    }
    EXPECT_TRUE(std::isnan(a[2 * 8 + 2]));
    EXPECT_EQ(a[1], 65504) << "beyond half";
    const auto red = read_plane(folder_ / "gold.exr", "R");
    EXPECT_EQ(d[0], float(half(std::abs(0.5f - float(red[0])))));
}

/// What the script names exists, and its brackets match: the check that runs where no browser is.
TEST_F(ComparePage, ItsScriptNamesWhatThereIs)
{
    const auto from = page_.rfind("<script>") + 8;
    const std::string script = page_.substr(from, page_.rfind("</script>") - from);
    std::set<std::string> ids;
    const std::regex id("id=\"([a-z-]+)\""),
        used("element\\(\"([a-z-]+)\"\\)|decode\\(\"([a-z-]+)\"\\)|stops\\(\"([a-z-]+)\"\\)");
    for (std::sregex_iterator m(page_.begin(), page_.begin() + std::ptrdiff_t(from), id), end; m != end; ++m)
        EXPECT_TRUE(ids.insert((*m)[1]).second) << (*m)[1] << " twice";
    std::size_t uses = 0;
    for (std::sregex_iterator m(script.begin(), script.end(), used), end; m != end; ++m, ++uses) {
        const std::string name = (*m)[1].str() + (*m)[2].str() + (*m)[3].str();
        EXPECT_TRUE(ids.contains(name)) << name;
    }
    EXPECT_GT(uses, 10u);
    std::string open;
    for (const char c : std::regex_replace(script, std::regex("/\\*[^*]*\\*/|\"[^\"\n]*\"|`[^`]*`"), "")) {
        if (c == '(' || c == '[' || c == '{')
            open += c;
        if (c != ')' && c != ']' && c != '}')
            continue;
        ASSERT_FALSE(open.empty());
        EXPECT_EQ(open.back(), c == ')' ? '(' : c == ']' ? '[' : '{');
        open.pop_back();
    }
    EXPECT_EQ(open, "");
    EXPECT_EQ(page_.find("@"), std::string::npos) << "a place that was not filled";
}

TEST_F(ComparePage, ShowsExposesAndBlinksInABrowser)
{
    if (std::system("command -v chromium >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no chromium; the tests above check the page's parts";
    const std::string probe = R"(<script>
const pixel = (id, x, y) => Array.from(element(id).getContext("2d").getImageData(x, y, 1, 1).data).join(",");
const wait = setInterval(() => {
  if (document.body.dataset.state !== "ready") return;
  clearInterval(wait);
  const said = [pixel("a", 2, 2), pixel("a", 0, 0), pixel("b", 0, 0)];
  element("exposure").value = -2;
  element("exposure").dispatchEvent(new Event("input"));
  said.push(pixel("a", 0, 0), element("exposure-stops").textContent);
  element("blink").click();
  said.push(pixel("a", 0, 0) === pixel("b", 0, 0), element("a-caption").textContent);
  element("blink").click();
  said.push(element("a-caption").textContent);
  document.body.dataset.said = said.join(" ");
}, 10);
</script></body>)";
    std::string page = page_;
    page.replace(page.rfind("</body>"), 7, probe);
    write_text(folder_ / "probe.html", page);
    const std::string dom = (folder_ / "dom").string();
    const std::string command = "cd '" + folder_.path().string() + "' && HOME='" + folder_.path().string() +
                                "' timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
                                "--virtual-time-budget=10000 --dump-dom 'file://" +
                                (folder_ / "probe.html").string() + "' >'" + dom + "' 2>'" + dom + ".err'";
    ASSERT_EQ(std::system(command.c_str()), 0) << read_text(dom + ".err");
    const std::string text = read_text(dom);
    const auto at = text.find("data-said=\"");
    ASSERT_NE(at, std::string::npos) << text.substr(0, 2000);
    const std::string said = text.substr(at + 11, text.find('"', at + 11) - at - 11);
    // sRGB of .5 is 188, of .125 it is 99; what is not finite is magenta.
    const auto green = read_plane(folder_ / "gold.exr", "G"), blue = read_plane(folder_ / "gold.exr", "B"),
               red = read_plane(folder_ / "gold.exr", "R");
    const auto shade = [](double v) {
        v = std::min(v, 1.0);
        return std::to_string(std::lround(255 * (v > 0.0031308 ? 1.055 * std::pow(v, 1 / 2.4) - 0.055 : 12.92 * v)));
    };
    const auto color = [&](double r, double scale) {
        return shade(r * scale) + "," + shade(green[0] * scale) + "," + shade(blue[0] * scale) + ",255";
    };
    EXPECT_EQ(said, "255,0,255,255 " + color(0.5, 1) + " " + color(red[0], 1) + " " + color(0.5, 0.25) + " -2 true B A");
}

}  // namespace
}  // namespace brume::tests
