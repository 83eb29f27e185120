//! The options that name the arrays of files.

use anyhow::anyhow;
use clap::Args;
use mms_exact::Input;
use mms_harness::profile;
use mms_judge::next;
use mms_judge::results::{axes, own_roles};
use mms_results::names::{Axes, Mapping, Names};

/// The options of every command that reads files of other programs.
#[derive(Args)]
pub struct Naming {
    /// Assign columns to a quantity: `X=x0,y0`, `u=disp`, or components of a column, counted from 0:
    /// `sigma=stress:0,stress:3,..`. In VTK `points` are the positions of the points, and `cells:NAME` is an array of cells.
    /// May be repeated.
    #[arg(long, value_name = "QUANTITY=COLUMN,..")]
    map: Vec<String>,
    /// The names of the columns of a table, in their order, as in `X,Y,u_x,u_y`. They replace a header if the table has one.
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    columns: Vec<String>,
    /// The code that wrote the files: a name that `mms list` prints, or the path of your own profile. A profile states the
    /// names of arrays, the order of components, and whether points are X or x if the numbers do not decide it.
    #[arg(long, value_name = "CODE")]
    from: Option<String>,
}

impl Naming {
    /// The names of arrays, in files about this field, or about none.
    ///
    /// # Errors
    /// An unknown profile, a mistake in a profile of one's own, with its place, or a mapping of no quantity.
    pub fn names(&self, input: Option<&Input>) -> anyhow::Result<Names> {
        let profile = self.from.as_deref().map(profile::find).transpose()?;
        let own = own_roles(&input.map_or(Vec::new(), Input::own_quantities));
        let axes = input.map_or(Axes::Cartesian, |it| axes(&it.compiled.field));
        let map = self.map.iter().map(|text| Mapping::read(text, &own));
        let map = map.collect::<Result<_, _>>().map_err(|mistake| anyhow!("`--map`: {mistake}"))?;
        Ok(Names { map, columns: self.columns.clone(), profile, own, axes })
    }

    /// The arguments that ask for them.
    pub fn arguments(&self) -> Vec<String> {
        let columns = next::list("columns", &self.columns).into_iter().collect();
        [next::each("map", &self.map), columns, next::each("from", self.from.as_slice())].concat()
    }

    /// The first option that is given; none if none is.
    pub fn given(&self) -> Option<&'static str> {
        let all = [
            ("--map", !self.map.is_empty()),
            ("--columns", !self.columns.is_empty()),
            ("--from", self.from.is_some()),
        ];
        all.into_iter().find(|(_, is_given)| *is_given).map(|(name, _)| name)
    }
}
