#include "gl/timer.h"

namespace brume::gl {
namespace {

constexpr int no_entry = -1;

}  // namespace

GlTimer::~GlTimer()
{
    for (const Frame *frame : {&recording_, &ended_})
        for (GLuint query : frame->queries)
            disposal_->add(Disposal::Kind::query, query);
}

void GlTimer::begin()
{
    recording_.entries.clear();
}

void GlTimer::mark(int entry)
{
    const size_t index = recording_.entries.size();
    if (index == recording_.queries.size()) {
        GLuint query = 0;
        glCreateQueries(GL_TIMESTAMP, 1, &query);
        recording_.queries.push_back(query);
    }
    glQueryCounter(recording_.queries[index], GL_TIMESTAMP);
    recording_.entries.push_back(entry);
}

void GlTimer::end()
{
    mark(no_entry);
    std::swap(recording_, ended_);
}

std::vector<double> GlTimer::milliseconds(int entries)
{
    if (ended_.entries.empty())
        return {};
    std::vector<GLuint64> times(ended_.entries.size());
    for (size_t i = 0; i < times.size(); ++i)
        glGetQueryObjectui64v(ended_.queries[i], GL_QUERY_RESULT, &times[i]);
    std::vector<double> sums(size_t(entries), 0.0);
    for (size_t i = 0; i + 1 < times.size(); ++i)
        if (const int entry = ended_.entries[i]; entry >= 0 && entry < entries)
            sums[size_t(entry)] += double(times[i + 1] - times[i]) * 1e-6;
    return sums;
}

}  // namespace brume::gl
