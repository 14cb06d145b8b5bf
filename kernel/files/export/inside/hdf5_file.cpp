// The library makes the file once: groups, attributes, and arrays that are contiguous, allocated early and never
// filled. From then on an array is a range of bytes, whose beginning H5Dget_offset() tells, and rows are written there
// with pwrite(): by any number of threads and processes, without the library, which is not made for several threads,
// and without its locks. Calls of the library take turns by a mutex. Large arrays begin at pages, so that they may be
// mapped into memory. Times are not tracked and the version of the format is fixed, so that equal content gives equal
// bytes. The memory of the machine must be little endian, as the arrays are.
#include "files/export/inside/hdf5_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little endian");

constexpr hsize_t page_size = 4096;  // where large arrays begin, so that they may be mapped into memory

// While this lives, its thread may call the library, which is not made for several threads.
class Hdf5Turn {
 public:
    Hdf5Turn() : lock_(mutex) {
        // At the end of the program the library would close once more all that it could not close on a full disk, and
        // crash.
        static const herr_t left_open = H5dont_atexit();
        (void)left_open;
        H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are exceptions here
    }
    Hdf5Turn(const Hdf5Turn&) = delete;
    Hdf5Turn& operator=(const Hdf5Turn&) = delete;
    ~Hdf5Turn() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }

 private:
    static inline std::mutex mutex;
    std::lock_guard<std::mutex> lock_;
    H5E_auto2_t print_ = nullptr;  // the program's own printing of errors
    void* print_data_ = nullptr;
};

[[noreturn]] void fail_hdf5(const std::string& path, const char* action, int error) {
    throw Error(ErrorCode::io,
                fmt::format("Cannot {} {}{}. Check the free space and the permissions of its folder, or "
                            "choose another one.",
                            action, path, error ? ": " + std::generic_category().message(error) : std::string()));
}

// An object that the library has open.
class Hdf5Id {
 public:
    Hdf5Id(hid_t id, herr_t (*close_it)(hid_t), const std::string& path) : id_(id), close_(close_it) {
        if (id < 0) fail_hdf5(path, "write", errno);
    }
    Hdf5Id(const Hdf5Id&) = delete;
    Hdf5Id& operator=(const Hdf5Id&) = delete;
    ~Hdf5Id() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }
    /// Whether the library could write what it still had.
    bool close() { return close_(std::exchange(id_, -1)) >= 0; }

 private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

hid_t file_type(Hdf5Type type) {
    switch (type) {
        case Hdf5Type::byte:
            return H5T_STD_U8LE;
        case Hdf5Type::character:
            return H5T_STD_I8LE;
        case Hdf5Type::int32:
            return H5T_STD_I32LE;
        case Hdf5Type::int64:
            return H5T_STD_I64LE;
        case Hdf5Type::real32:
            return H5T_IEEE_F32LE;
        case Hdf5Type::real:
            break;
    }
    return H5T_IEEE_F64LE;
}

// Returns the comment of the root group, which no reader of a format minds. It is set first, and so lies in the first
// bytes of the file.
std::string comment_of(std::string_view format) { return fmt::format("Kerf's mesh: {}.", format); }

// Makes the file with all arrays, which have no values yet.
class Hdf5Creation {
 public:
    Hdf5Creation(const std::string& path, const Hdf5Content& content)
        : path_(path),
          tracks_order_(content.tracks_order),
          file_(created(path, content.tracks_order), H5Fclose, path),
          array_properties_(property_list(H5P_DATASET_CREATE)) {
        check(H5Oset_comment(file_, comment_of(content.format).c_str()));
        check(H5Pset_layout(array_properties_, H5D_CONTIGUOUS));
        check(H5Pset_alloc_time(array_properties_, H5D_ALLOC_TIME_EARLY));
        check(H5Pset_fill_time(array_properties_, H5D_FILL_TIME_NEVER));
    }

    void make_groups(const std::vector<std::string>& names) {
        const Hdf5Id properties = property_list(H5P_GROUP_CREATE);
        if (tracks_order_) track_order(properties);
        for (const std::string& name : names)
            open(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
    }

    void make(const Hdf5Array& array) {
        const hsize_t size[] = {static_cast<hsize_t>(array.rows), static_cast<hsize_t>(array.columns)};
        const Hdf5Id space = open(H5Screate_simple(array.columns ? 2 : 1, size, nullptr), H5Sclose);
        const Hdf5Id made = make_array(array.name, file_type(array.type), space);
        if (!array.bytes.empty())
            check(H5Dwrite(made, file_type(array.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.bytes.data()));
    }

    // Makes an array of names, in UTF-8, filled up with zero bytes.
    void make_names(const Hdf5Names& array) {
        std::size_t length = std::max<std::size_t>(array.characters, 1);
        for (const std::string& each : array.names) length = std::max(length, each.size());
        std::string bytes;
        for (const std::string& each : array.names) bytes += each + std::string(length - each.size(), '\0');
        const Hdf5Id type = array.characters ? characters_type(length) : string_type(length, H5T_CSET_UTF8);
        const hsize_t size = array.names.size();
        const Hdf5Id space = open(H5Screate_simple(1, &size, nullptr), H5Sclose);
        const Hdf5Id made = make_array(array.name, type, space);
        check(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()));
    }

    void set(const Hdf5Attribute& attribute) {
        if (const auto* text = std::get_if<std::string>(&attribute.value)) {
            const Hdf5Id type = string_type(text->size(), H5T_CSET_ASCII);
            const Hdf5Id space = open(H5Screate(H5S_SCALAR), H5Sclose);
            return set(attribute, type, space, text->data());
        }
        if (const auto* values = std::get_if<std::vector<std::int32_t>>(&attribute.value)) {
            const hsize_t size = values->size();
            const Hdf5Id space = open(H5Screate_simple(1, &size, nullptr), H5Sclose);
            return set(attribute, H5T_STD_I32LE, space, values->data());
        }
        const Hdf5Id space = open(H5Screate(H5S_SCALAR), H5Sclose);
        if (const auto* number = std::get_if<std::int32_t>(&attribute.value))
            set(attribute, H5T_STD_I32LE, space, number);
        else
            set(attribute, H5T_IEEE_F64LE, space, &std::get<double>(attribute.value));
    }

    void close() {
        if (!file_.close()) fail_hdf5(path_, "write", errno);
    }

 private:
    static void track_no_times(hid_t properties) { H5Pset_obj_track_times(properties, false); }

    static void track_order(hid_t properties) {
        H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    }

    static hid_t created(const std::string& path, bool tracks_order) {
        const Hdf5Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, path),
            access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
        track_no_times(creation);
        if (tracks_order) track_order(creation);
        H5Pset_est_link_info(creation, 8, 16);  // room in the header of the root group, for its comment
        H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
        H5Pset_file_locking(access, false, true);
        H5Pset_alignment(access, page_size, page_size);
        return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
    }

    Hdf5Id open(hid_t id, herr_t (*close_it)(hid_t)) const { return Hdf5Id(id, close_it, path_); }
    void check(herr_t result) const {
        if (result < 0) fail_hdf5(path_, "write", errno);
    }

    Hdf5Id property_list(hid_t kind) const {
        const hid_t properties = H5Pcreate(kind);
        track_no_times(properties);
        return open(properties, H5Pclose);
    }

    Hdf5Id string_type(std::size_t length, H5T_cset_t set) const {
        const hid_t type = H5Tcopy(H5T_C_S1);
        check(H5Tset_size(type, length));
        check(H5Tset_strpad(type, H5T_STR_NULLPAD));
        check(H5Tset_cset(type, set));
        return open(type, H5Tclose);
    }

    Hdf5Id characters_type(hsize_t count) const { return open(H5Tarray_create2(H5T_STD_I8LE, 1, &count), H5Tclose); }

    Hdf5Id make_array(const std::string& name, hid_t type, hid_t space) const {
        return open(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, array_properties_, H5P_DEFAULT),
                    H5Dclose);
    }

    void set(const Hdf5Attribute& attribute, hid_t type, hid_t space, const void* value) {
        const Hdf5Id of = open(H5Acreate_by_name(file_, attribute.object.c_str(), attribute.name, type, space,
                                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
        check(H5Awrite(of, type, value));
    }

    std::string path_;
    bool tracks_order_;
    Hdf5Id file_;
    Hdf5Id array_properties_;
};

}  // namespace

bool is_hdf5_of(std::string_view format, std::string_view beginning) {
    return beginning.starts_with("\x89HDF\r\n") && beginning.find(comment_of(format)) != beginning.npos;
}

void make_hdf5_file(const std::string& path, const Hdf5Content& content) {
    const Hdf5Turn turn;
    Hdf5Creation file(path, content);
    file.make_groups(content.groups);
    for (const Hdf5Array& array : content.arrays) file.make(array);
    for (const Hdf5Names& names : content.names) file.make_names(names);
    for (const Hdf5Attribute& attribute : content.attributes) file.set(attribute);
    file.close();
}

Hdf5Bytes::Hdf5Bytes(const std::string& path, const std::vector<Hdf5Array>& arrays)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (file_ < 0) fail_hdf5(path, "open", errno);
    const Hdf5Turn turn;
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
    H5Pset_file_locking(access, false, true);
    const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, path);
    for (const Hdf5Array& array : arrays) {
        const Hdf5Id opened(H5Dopen2(file, array.name.c_str(), H5P_DEFAULT), H5Dclose, path);
        places_.push_back({array.name, static_cast<std::int64_t>(H5Dget_offset(opened)),
                           std::max<std::int64_t>(array.columns, 1) * size_of(array.type)});
    }
}

Hdf5Bytes::~Hdf5Bytes() {
    if (file_ >= 0) ::close(file_);
}

std::int64_t Hdf5Bytes::place_of(std::string_view name, std::int64_t row) const {
    for (const Place& place : places_)
        if (place.name == name) return place.begin + row * place.row_size;
    throw Error(ErrorCode::internal, fmt::format("{} has no array {}.", path_, name));
}

void Hdf5Bytes::write(const void* data, std::size_t size, std::int64_t place) const {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::pwrite(file_, bytes, size, place);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail_hdf5(path_, "write", errno);
        bytes += written;
        size -= written;
        place += written;
    }
}

void Hdf5Bytes::close() {
    if (::close(std::exchange(file_, -1)) != 0) fail_hdf5(path_, "write", errno);
}

}  // namespace kerf
