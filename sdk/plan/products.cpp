#include "plan/products.h"

#include <algorithm>

namespace brume {

Products::Product &Products::of(std::string_view name)
{
    const auto found = std::find_if(products_.begin(), products_.end(), [&](const Product &p) { return p.name == name; });
    return found != products_.end() ? *found : products_.emplace_back(Product{std::string(name), {}, 0, 0});
}

void Products::publish(std::string_view name, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
                       uint64_t revision)
{
    Product &product = of(name);
    product.images.assign(images, images + image_count);
    product.count = count;
    product.revision = revision;
}

}  // namespace brume
