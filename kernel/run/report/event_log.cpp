// Each event is one line of JSON, flushed at once, so that a reader of a pipe sees it when it happens. A reader that
// leaves ends the log, not the run: ReaderLeft closes the file, and later events go nowhere; other errors of writing
// are those of the run, but for the last event, which comes when it has ended. Progress is told once for each stage,
// not for each step. Members of a part's event that would be empty are left out.
#include "run/report/event_log.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "files/io/checked_file.h"
#include "files/io/json.h"
#include "files/io/output_file.h"
#include "files/io/path_text.h"
#include "run/report/inside/recovery_json.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

std::string absolute(const std::string& path) {
    return path.empty() ? path : path_text(std::filesystem::absolute(path).lexically_normal().string());
}

}  // namespace

EventLog::EventLog(const std::string& target) : file_(std::make_unique<CheckedFile>(open_output(target), target)) {}

EventLog::~EventLog() = default;

template <class Object>
void EventLog::write(Object json) {
    json["seconds"] = stopwatch_.seconds();
    if (!file_) return;
    try {
        file_->write(json_text(json) + "\n");
        file_->flush();
    } catch (const ReaderLeft&) {
        file_.reset();
    }
}

void EventLog::on_start(const RunRequest& request) {
    write(Json{{"event", "run"},
               {"input", absolute(request.input)},
               {"scale", request.input_options.scale},
               {"output", request.dry_run ? "" : absolute(request.output)},
               {"trace", absolute(request.outputs.trace_file)},
               {"parts", request.parts}});
}

void EventLog::on_progress(const char* stage, std::size_t, std::size_t) {
    if (stage_ == stage) return;
    stage_ = stage;
    write(Json{{"event", "stage"}, {"stage", stage}});
}

void EventLog::on_parts(const std::vector<PartReport>& parts, const std::string&) {
    Json list = Json::array();
    for (const PartReport& part : parts)
        list.push_back({{"id", part.id},
                        {"load", part.load},
                        {"facets", part.surface_facets},
                        {"volume", part.surface_volume},
                        {"resumed", part.resumed}});
    write(Json{{"event", "parts"}, {"parts", list}});
}

void EventLog::on_part(const PartEvent& event) {
    const PartReport& part = *event.part;
    Json json = {{"event", "part"},
                 {"id", part.id},
                 {"state", part.result.code ? "failed"
                           : part.resumed   ? "resumed"
                                            : "done"},
                 {"rank", part.rank},
                 {"worker", part.worker},
                 {"mesher", part.result.mesher},
                 {"attempts", part.attempts},
                 {"tets", part.result.tets},
                 {"part_seconds", part.seconds},
                 {"parts_done", event.done},
                 {"parts", event.total},
                 {"load_done", event.load_done},
                 {"tets_done", event.tets}};
    if (part.result.code) json["message"] = part.result.message;
    add_way(part, json);
    write(std::move(json));
}

void EventLog::on_equations(std::int64_t unknowns) { write(Json{{"event", "equations"}, {"unknowns", unknowns}}); }

void EventLog::on_solver_iteration(int iteration, double residual, double wanted, double seconds_left) {
    write(Json{{"event", "iteration"},
               {"iteration", iteration},
               {"residual", residual},
               {"wanted", wanted},
               {"seconds_left", seconds_left}});
}

void EventLog::on_working(const std::string& stage, std::size_t done, std::size_t total, double stage_seconds) {
    write(Json{
        {"event", "working"}, {"stage", stage}, {"done", done}, {"total", total}, {"stage_seconds", stage_seconds}});
}

void EventLog::on_end(int exit_code, const std::string& message) {
    Json json = {{"event", "end"}, {"exit_code", exit_code}};
    if (!message.empty()) json["message"] = message;
    try {
        write(std::move(json));
    } catch (const Error&) {
    }
}

}  // namespace kerf
