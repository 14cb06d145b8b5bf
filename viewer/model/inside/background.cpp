#include "viewer/model/inside/background.h"

#include <utility>

namespace kerf::view {

void Background::Group::reset() {
    scope->end();
    scope = std::make_shared<Scope>();
    jobs = 0;
}

void Background::post(Group& group, Loader::Work work, Failed failed) {
    ++group.jobs;
    const auto counted = [&group, work = std::move(work)]() -> Loader::Completion {
        return [&group, completion = work()] {
            --group.jobs;
            if (completion) completion();
        };
    };
    if (!failed) failed = [this](const Error& error) { note_failure(error); };
    loader_->post({group.scope, counted, [&group, failed = std::move(failed)](const Error& error) {
                       --group.jobs;
                       failed(error);
                   }});
}

void Background::post_idle(const Group& group, Loader::Work work) {
    loader_->post_idle({group.scope, std::move(work), {}});
}

bool Background::take_over() {
    in_vain_ = 0;
    const std::size_t done = loader_->take_over();
    return done > in_vain_;
}

void Background::end() {
    for (Group* group : {&open, &data, &redo, &repair, &watch}) group->reset();
    loader_.reset();
}

void Background::note_failure(const std::string& message, ErrorCode code) {
    constexpr std::size_t limit = 100;
    if (message.empty()) return;
    if (failures_.empty()) failure_code_ = code;
    failures_.push_back(message);
    if (failures_.size() > limit) failures_.erase(failures_.begin());
}

}  // namespace kerf::view
