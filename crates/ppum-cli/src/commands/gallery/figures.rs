//! The figures, each with its problem files and the commands that make it.

/// A figure of the paper.
pub(super) struct Figure {
    /// Its number.
    pub(super) number: u32,
    /// What it shows.
    pub(super) title: &'static str,
    /// Names and texts of its files.
    pub(super) files: &'static [(&'static str, &'static str)],
    /// The command lines; `@` stands for the folder.
    pub(super) lines: &'static [&'static str],
}

/// A file of the folder `examples`.
macro_rules! example {
    ($name:literal) => {
        ($name, include_str!(concat!("../../../../../examples/", $name)))
    };
}

pub(super) const ALL: &[Figure] = &[
    Figure {
        number: 1,
        title: "points, cells and patches",
        files: &[example!("scattered-points.toml"), example!("scattered-points.csv")],
        lines: &[
            "solve @/scattered-points.toml",
            "render @/scattered-points.h5 -o @/figure-1-cells.png --figure --blank --overlay points,cells --size 700x600",
            "render @/scattered-points.h5 -o @/figure-1-patches.png --figure --blank --overlay points,patches --size 700x600",
        ],
    },
    Figure {
        number: 2,
        title: "enrichment of the patches around a crack",
        files: &[example!("paper-enrichment.toml")],
        lines: &[
            "solve @/paper-enrichment.toml",
            "render @/paper-enrichment.h5 -o @/figure-2.png --figure --blank --overlay cells,centers,cracks --size 800x700",
        ],
    },
    Figure {
        number: 3,
        title: "the passes of a picture: weights, field, gradient, quantity",
        files: &[example!("paper-enrichment.toml")],
        lines: &[
            "solve @/paper-enrichment.toml",
            "render @/paper-enrichment.h5 -o @/figure-3.png -q weight-sum,uy,duy_dy,von-mises --layout 2x2 --size 1200x1000 --tip 0 --zoom 2",
        ],
    },
    Figure {
        number: 4,
        title: "the four functions of a crack tip",
        files: &[example!("paper-tip-functions.toml")],
        lines: &[
            "solve @/paper-tip-functions.toml",
            "render @/paper-tip-functions.h5 -o @/figure-4.png -q tip-1,tip-2,tip-3,tip-4 --layout 2x2 --shared-range --colormap vik --range -1,1 --isolines 15 --size 1200x1000",
        ],
    },
    Figure {
        number: 5,
        title: "the centre crack, resampled and direct",
        files: &[example!("paper-centre-crack.toml")],
        lines: &[
            "solve @/paper-centre-crack.toml",
            "compare @/paper-centre-crack.h5 -o @/figure-5-ab.png --grid 64 --range 0,4",
            "compare @/paper-centre-crack.h5 -o @/figure-5-cd.png --grid 2048 --range 0,4",
            "compare @/paper-centre-crack.h5 -o @/figure-5-ef.png --grid 2048 --tip 1 --zoom 150 --range 0,20",
            "render @/paper-centre-crack.h5 -o @/figure-5-middle.png --figure --center 0,0 --width 0.4",
        ],
    },
    Figure {
        number: 6,
        title: "cracks that cross, branch and end on each other",
        files: &[example!("meeting-cracks.toml")],
        lines: &[
            "solve @/meeting-cracks.toml",
            "render @/meeting-cracks.h5 -o @/figure-6.png --figure",
            "render @/meeting-cracks.h5 -o @/figure-6-star.png --figure --center=-0.246,0.258 --width 0.5 --overlay cracks,cells --size 700x600",
            "render @/meeting-cracks.h5 -o @/figure-6-junction.png --figure --center=-0.246,0.258 --width 1e-9 --overlay cracks --size 700x600",
        ],
    },
    Figure {
        number: 7,
        title: "a crack that grows, in four steps and moving",
        files: &[example!("edge-shear-growth.toml")],
        lines: &[
            "solve @/edge-shear-growth.toml",
            "render @/edge-shear-growth.h5 -o @/figure-7-000.png -q magnitude,von-mises --layout 2x1 --step 0 --view 0,4,7,12 --size 900x480",
            "render @/edge-shear-growth.h5 -o @/figure-7-005.png -q magnitude,von-mises --layout 2x1 --step 5 --view 0,4,7,12 --size 900x480",
            "render @/edge-shear-growth.h5 -o @/figure-7-010.png -q magnitude,von-mises --layout 2x1 --step 10 --view 0,4,7,12 --size 900x480",
            "render @/edge-shear-growth.h5 -o @/figure-7-013.png -q magnitude,von-mises --layout 2x1 --step 13 --view 0,4,7,12 --size 900x480",
            "render @/edge-shear-growth.h5 -o @/figure-7.gif --steps ..13 --fps 4 --figure --view 0,4,7,12 --range 0,60 --size 480x480",
        ],
    },
    Figure {
        number: 8,
        title: "covers that adapt, order 1 beside order 2",
        files: &[example!("paper-adaptive-1.toml"), example!("paper-adaptive-2.toml")],
        lines: &[
            "solve @/paper-adaptive-1.toml",
            "solve @/paper-adaptive-2.toml",
            "render @/paper-adaptive-1.h5 -o @/figure-8-order-1.png --figure --range 0,400 --overlay boxes --size 800x700",
            "render @/paper-adaptive-2.h5 -o @/figure-8-order-2.png --figure --range 0,400 --overlay boxes --size 800x700",
            "render @/paper-adaptive-1.h5 -o @/figure-8-order-1-tip.png --figure --range 0,400 --overlay boxes --center=-0.75,0.35 --width 0.3 --size 800x700",
            "render @/paper-adaptive-2.h5 -o @/figure-8-order-2-tip.png --figure --range 0,400 --overlay boxes --center=-0.75,0.35 --width 0.3 --size 800x700",
        ],
    },
];
