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

    /// Those of one cell.
    pub(crate) fn of(&self, cell: usize) -> &[Node] {
        &self.nodes[self.starts[cell]..self.starts[cell + 1]]
    }
}
