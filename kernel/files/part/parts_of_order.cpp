#include "files/part/parts_of_order.h"

#include "files/part/second_order_parts.h"

namespace kerf {

namespace {

class FirstOrderParts : public PartSource {
 public:
    explicit FirstOrderParts(const PartSource& parts) : parts_(parts), outline_(parts.outline()) {
        outline_.order = 1;
        outline_.edge_nodes = 0;
        for (PartExtent& part : outline_.parts) part.edge_nodes = 0;
    }
    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override { return without_edge_nodes(parts_.load(index)); }
    Part load_only(PartIndex index, PartContent content) const override {
        return without_edge_nodes(parts_.load_only(index, content));
    }
    const RegionWalls& walls() const override { return parts_.walls(); }

 private:
    static Part without_edge_nodes(Part part) {
        part.edge_nodes = {};
        for (PartValues& values : part.values)
            if (values.of == PartValues::Of::points)
                std::visit([&](auto& numbers) { numbers.resize(values.components * part.vertex_count()); },
                           values.numbers);
        return part;
    }

    const PartSource& parts_;
    MeshOutline outline_;
};

}  // namespace

std::unique_ptr<PartSource> parts_of_order(const PartSource& parts, int order,
                                           const std::function<EdgeNumbers()>& number) {
    if (order == 0 || order == parts.outline().order) return nullptr;
    if (order == 1) return std::make_unique<FirstOrderParts>(parts);
    return std::make_unique<SecondOrderParts>(parts, number());
}

}  // namespace kerf
