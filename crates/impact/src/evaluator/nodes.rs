//! Where a force is read within the cells of a run, so that its integrals are exact.

/// A place in a cell: x from -1/2 to 1/2 in time, its weight in a mean over the cell, and the force there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    pub(crate) x: f64,
    pub(crate) weight: f64,
    pub(crate) force: f64,
}

/// Nodes of quadrature in the cells between the samples of a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct CellNodes {
    /// First node of each cell, and the end.
    starts: Vec<usize>,
    nodes: Vec<Node>,
}

impl CellNodes {
    /// Of `cells` cells, filled one by one.
    pub(crate) fn new(cells: usize, mut fill: impl FnMut(usize, &mut Vec<Node>)) -> Self {
        let mut found = Self::default();
        for cell in 0..cells {
            found.starts.push(found.nodes.len());
            fill(cell, &mut found.nodes);
        }
        found.starts.push(found.nodes.len());
        found
    }

    /// The same places with other forces, by their number.
    pub(crate) fn with(&self, force: impl Fn(usize) -> f64) -> Self {
        let nodes = self.nodes.iter().enumerate();
        Self {
            starts: self.starts.clone(),
            nodes: nodes
                .map(|(i, node)| Node {
                    force: force(i),
                    ..*node
                })
                .collect(),
        }
    }

    /// All places as times in cells from the start of the first.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        let cells = self.starts.windows(2).enumerate();
        cells.flat_map(|(cell, ends)| {
            let own = self.nodes[ends[0]..ends[1]].iter();
            own.map(move |node| cell as f64 + 0.5 + node.x)
        })
    }

    /// The forces at all places.
    pub(crate) fn forces(&self) -> impl Iterator<Item = f64> {
        self.nodes.iter().map(|node| node.force)
    }

    /// Those of one cell.
    pub(crate) fn of(&self, cell: usize) -> &[Node] {
        &self.nodes[self.starts[cell]..self.starts[cell + 1]]
    }
}
