// An events file has a JSON object on each line, to which the run adds lines. EventTail remembers its position in bytes
// and the begin of a line that has no end yet, so that a line is parsed once, when it is complete. Lines that are no
// events are passed over, and kinds of events that this version does not know become `other`, so that runs of other
// versions can be followed. Numbers that an event does not tell are negative and leave the row of the tree as it is.
#include "viewer/model/inside/run_events.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "files/io/json.h"
#include "files/io/path_text.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

namespace {

using Json = nlohmann::json;

RunEvent::Kind kind_of(const std::string& name) {
    if (name == "run") return RunEvent::Kind::run;
    if (name == "stage") return RunEvent::Kind::stage;
    if (name == "parts") return RunEvent::Kind::parts;
    if (name == "part") return RunEvent::Kind::part;
    if (name == "end") return RunEvent::Kind::end;
    return RunEvent::Kind::other;
}

RunEvent::Part announced_part(const Json& json) {
    RunEvent::Part part;
    part.id = json.at("id").get<NodeId>();
    part.load = json.value("load", -1.0);
    part.facets = json.value("facets", std::int64_t{-1});
    part.volume = json.value("volume", -1.0);
    return part;
}

RunEvent::Part ended_part(const Json& json) {
    RunEvent::Part part;
    part.id = json.at("id").get<NodeId>();
    part.state = json.at("state") == "failed" ? NodeState::failed : NodeState::done;
    part.rank = json.value("rank", -1);
    part.tets = json.value("tets", std::int64_t{-1});
    part.seconds = json.value("part_seconds", -1.0);
    part.message = json.value("message", json.value("remedy", ""));
    part.filled_by = name_of_filler(json.value("mesher", ""), json.value("way", ""));
    part.core_tets = json.value("core_tets", std::int64_t{0});
    return part;
}

// Throws exceptions of the JSON library.
RunEvent event_from_json(const Json& json) {
    RunEvent event;
    event.kind = kind_of(json.at("event").get<std::string>());
    event.seconds = json.value("seconds", 0.0);
    switch (event.kind) {
        case RunEvent::Kind::run:
            event.input = path_of_text(json.value("input", ""));
            event.scale = json.value("scale", 1.0);
            event.output = path_of_text(json.value("output", ""));
            event.trace = path_of_text(json.value("trace", ""));
            event.parts_total = json.value("parts", std::int64_t{0});
            break;
        case RunEvent::Kind::stage:
            event.stage = json.at("stage").get<std::string>();
            break;
        case RunEvent::Kind::parts:
            for (const Json& part : json.at("parts")) event.parts.push_back(announced_part(part));
            event.parts_total = std::ssize(event.parts);
            break;
        case RunEvent::Kind::part:
            event.parts.push_back(ended_part(json));
            event.parts_done = json.at("parts_done").get<std::int64_t>();
            event.parts_total = json.at("parts").get<std::int64_t>();
            event.load_done = json.at("load_done").get<double>();
            break;
        case RunEvent::Kind::end:
            event.exit_code = json.at("exit_code").get<int>();
            event.message = json.value("message", "");
            break;
        case RunEvent::Kind::other:
            break;
    }
    return event;
}

}  // namespace

std::vector<RunEvent> EventTail::read_new() {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path_, error);
    if (error || size <= position_) return {};
    std::ifstream file(path_, std::ios::binary);
    file.seekg(position_);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    position_ += bytes.size();
    rest_ += bytes;
    std::vector<RunEvent> events;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = rest_.find('\n', begin)) != rest_.npos; begin = end + 1) {
        try {
            events.push_back(event_from_json(parse_json(std::string_view(rest_).substr(begin, end - begin))));
        } catch (const Json::exception&) {  // no line of ours
        }
    }
    rest_.erase(0, begin);
    return events;
}

void apply_to_tree(const RunEvent& event, Tree& tree) {
    if (event.kind == RunEvent::Kind::parts && tree.rows.size() <= 1) {
        std::vector<NodeId> ids;
        for (const RunEvent::Part& part : event.parts) ids.push_back(part.id);
        tree = tree_of(ids);
    }
    for (const RunEvent::Part& part : event.parts) {
        TreeRow& row = tree.at(part.id);
        row.state = part.state;
        if (part.load >= 0) row.load = part.load;
        if (part.volume >= 0) row.volume = part.volume;
        if (part.facets >= 0) row.facets = part.facets;
        if (part.tets >= 0) row.tets = part.tets;
        if (part.seconds >= 0) row.seconds = part.seconds;
        if (part.rank >= 0) row.rank = part.rank;
        row.message = part.message;
        row.filled_by = part.filled_by;
        row.core_tets = part.core_tets;
    }
}

void apply_to_progress(const RunEvent& event, Progress& progress) {
    progress.seconds = std::max(progress.seconds, event.seconds);
    if (event.kind == RunEvent::Kind::stage) progress.stage = event.stage;
    if (event.parts_total > 0) progress.parts = event.parts_total;
    if (event.kind != RunEvent::Kind::part) return;
    progress.parts_done = event.parts_done;
    progress.load_done = event.load_done;
}

}  // namespace kerf::view
