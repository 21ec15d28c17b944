use frangible_bake::{BodyMesh, Shape};
fn main(){
 for (n,s) in [("glass",Shape::drinking_glass()),("vase",Shape::vase()),("pane",Shape::plate(0.3,0.3,0.004)),("block",Shape::block([0.1;3]))] {
  let m=s.fracture_mesh(s.fracture_size().unwrap(),1).unwrap();
  let mut v:Vec<(f64,usize)>=(0..m.tets.len()).map(|e|{let one=BodyMesh{positions:m.corners(e).to_vec(),tets:vec![[0,1,2,3]],cell_of_tet:vec![0],cells:1};(one.min_dihedral(),e)}).collect();
  v.sort_by(|a,b|a.0.total_cmp(&b.0));
  println!("{n} edge {:?} pct 0.1 {:.1} 1 {:.1} 5 {:.1} 50 {:.1}",s.fracture_size(),v[v.len()/1000].0,v[v.len()/100].0,v[v.len()/20].0,v[v.len()/2].0);
  for (d,e) in v.iter().take(12){let c=m.corners(*e).iter().sum::<frangible::glam::DVec3>()/4.0; println!("  {d:.1} r {:.4} z {:.4} {:?}",c.truncate().length(),c.z, m.corners(*e).map(|p|((p.truncate().length()*1e4).round()/10.,(p.z*1e4).round()/10.)));}
  // surface obj dump
  let t=frangible::TetMesh::new(m.positions.iter().map(|p|p.as_vec3()).collect(),m.tets.clone());
  let mut o=String::new(); for p in &t.positions{o+=&format!("v {} {} {}\n",p.x,p.y,p.z);} for (f,_) in t.boundary(){o+=&format!("f {} {} {}\n",f[0]+1,f[1]+1,f[2]+1);} std::fs::write(format!("/tmp/{n}.obj"),o).unwrap();
 }
}
