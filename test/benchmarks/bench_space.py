"""Planning in space: a forest, a wall with two windows, a ring that hangs free, and a building of two storeys with two stairwells.

Times are medians of 11 plans on this machine; a map is made ready once. dynamicEDT3D, OctoMap's own library of distances, stands beside ours
where it is installed: time and memory for the same corners of cells, and where it overstates distances, which are exact here.
"""
from benchmarks import benchmark


def add_arguments(parser):
    parser.add_argument("--maps", metavar="DIR", help="write the maps there as OctoMap files")
    parser.add_argument("--json", metavar="FILE", help="write the rows there")


def print_row(row):
    certified = sum(each["certified"] for each in row["candidates"])
    costs = "  ".join(f"{each['cost']:.2f}" for each in row["candidates"])
    print(f"{row['world']:12}{row['voxels']:9}{1e3 * row['field_s']:9.0f} ms{1e3 * row['map_s']:8.0f} ms{row['curves']:8}{row['bodies']:8}"
          f"{row['landmarks']:11}{1e3 * row['plan_s']:8.1f} ms{certified:5}/{len(row['candidates'])}   {costs}")


def run(options):
    result = benchmark.run("space", *([options.maps] if options.maps else []))
    print(f"{'world':12}{'voxels':>9}{'distances':>12}{'map':>11}{'curves':>8}{'bodies':>8}{'landmarks':>11}{'plan':>11}{'certified':>10} costs")
    for row in result["rows"]:
        print_row(row)
    for row in result["rows"]:
        if "peer_s" in row:
            print(f"{row['world']:12} dynamicEDT3D: {row['peer_s'] / row['field_one_side_s']:.0f} times as long, {row['peer_bytes'] / row['field_bytes']:.0f} times"
                  f" the memory, overstates the distance at {row['peer_overstates']} corners by up to {row['peer_most_cells']:.3f} cells")
    benchmark.write(result, options.json)
    return 0
