#include "run/journal.h"

#include <filesystem>

#include "core/bytes.h"
#include "core/error.h"
#include "core/hash.h"
#include "io/durable_file.h"
#include "io/file_bytes.h"
#include "run/version.h"

namespace kerf {

namespace {

// A file of the journal: the hash of the record, then the record.
struct Record {
    std::uint64_t hash = 0;
    Bytes bytes;

    template <class Archive>
    void archive(Archive& a) {
        a(hash, bytes);
    }
};

}  // namespace

FileHash hash_of_job(const PartJob& job, const MesherOptions& mesher, std::int32_t attempts) {
    Hasher hasher;
    hasher.add(std::span<const char>(to_bytes(job)));
    hasher.add(std::span<const char>(to_bytes(mesher)));
    hasher.add(std::span<const std::int32_t>(&attempts, 1));
    hasher.add(std::span<const char>(std::string_view(version)));
    return hasher.digest();
}

void write_journal_entry(const std::string& path, const JournalEntry& entry) {
    Record record;
    record.bytes = to_bytes(entry);
    record.hash = hash_bytes(record.bytes);
    write_durable_file(path, to_bytes(record));
}

std::optional<JournalEntry> read_journal_entry(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    try {
        const auto record = from_bytes<Record>(read_file(path));
        if (hash_bytes(record.bytes) == record.hash) return from_bytes<JournalEntry>(record.bytes);
    } catch (const Error&) {  // damaged
    }
    return {};
}

std::optional<PartOutcome> find_finished_part(const std::string& journal_file, const std::string& part_file,
                                              const FileHash& job_hash, double timeout_seconds) {
    const std::optional<JournalEntry> entry = read_journal_entry(journal_file);
    if (!entry || entry->job_hash != job_hash) return {};
    if (entry->timeout_seconds > 0 && entry->timeout_seconds != timeout_seconds) return {};
    try {
        if (hash_of_part_file(part_file) == entry->outcome.result.file_hash) return entry->outcome;
    } catch (const Error&) {  // missing or damaged
    }
    return {};
}

}  // namespace kerf
