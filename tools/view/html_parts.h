// What stands in every page: its style and its script. The page is complete without the script, which adds the search
// and leads from a name in a drawing to its row in the tables.
#pragma once
#include <string_view>

namespace rung::view {

inline constexpr std::string_view kPageStyle = R"(
body{margin:0;padding:0 24px 48px;background:var(--paper);color:var(--ink);font:15px/1.45 Arial,Helvetica,"DejaVu Sans",sans-serif}
h1{font-size:26px;margin:24px 0 4px}
h2{font-size:22px;margin:40px 0 8px;border-bottom:2px solid var(--ink)}
h3{font-size:17px;margin:32px 0 8px}
h2 small,h3 small{font-weight:normal;font-size:13px;color:var(--soft)}
a{color:var(--link);text-decoration:none}
a:hover{text-decoration:underline}
nav ul{margin:4px 0;padding-left:20px;columns:16em}
p.C{white-space:pre-line;margin:12px 0 4px}
.f{font-size:12px;color:var(--soft)}
.R{margin:0;padding:14px 0 0;overflow-x:auto}
.R:target{background:var(--found)}
figcaption{margin-bottom:4px;display:flex;gap:12px;align-items:baseline;font-size:15px}
figcaption b{min-width:28px}
figcaption span{font-weight:bold;flex:1}
figcaption .f{font-family:"DejaVu Sans Mono",Consolas,Menlo,monospace}
.R p{margin:2px 0 0 40px;font-size:13px;color:var(--note)}
.R svg{display:block}
.G,.T{content-visibility:auto}
table{border-collapse:collapse;table-layout:fixed;width:100%;max-width:1100px}
th,td{text-align:left;vertical-align:top;padding:3px 14px 3px 0;border-bottom:1px solid var(--line);font-size:13px}
th:nth-child(1){width:20%}
th:nth-child(2){width:14%}
th:nth-child(3){width:32%}
.V th:nth-child(1){width:10%}
.V th:nth-child(2){width:50%}
.V th:nth-child(3){width:20%}
td,tbody th{overflow-wrap:anywhere}
tbody th,td.v{font-family:"DejaVu Sans Mono",Consolas,Menlo,monospace}
td.q{padding-top:12px;color:var(--note);font-style:italic}
tr:target{background:var(--found)}
#find{position:sticky;top:0;z-index:1;background:var(--paper);padding:8px 0;border-bottom:1px solid var(--line);display:flex;gap:8px}
#find input{font:inherit;width:22em;padding:3px 6px}
#find button{font:inherit;padding:2px 12px}
.R,h2,h3,tr{scroll-margin-top:56px}
.J .n text{cursor:pointer}
.H0,.H1,.H2,.H3,.H4,.H5,.N{border-left:8px solid var(--line);padding-left:10px;print-color-adjust:exact}
.H1{border-left-color:var(--heat1)}
.H2{border-left-color:var(--heat2)}
.H3{border-left-color:var(--heat3)}
.H4{border-left-color:var(--heat4)}
.H5{border-left-color:var(--heat5)}
.N{border-left:8px double var(--warn)}
.N .o{color:var(--warn)}
.o{font-style:normal;font-size:13px;white-space:nowrap}
.o s{display:inline-block;height:9px;margin-right:6px;background:var(--heat4);border:1px solid var(--ink);print-color-adjust:exact}
.lg span{margin-right:24px;white-space:nowrap}
.sw{display:inline-block;box-sizing:border-box;width:22px;height:14px;padding:0;vertical-align:-2px}
.sw.qa{border:1px solid var(--good)}
.sw.qp{border:2px dashed var(--part)}
.sw.qn{border:2px dotted var(--warn)}
.sw.H1,.sw.H2,.sw.H3,.sw.H4,.sw.H5{border-left-width:22px}
.most span{font-weight:bold;margin:0 12px}
.Y th:nth-child(1){width:7%}
.Y th:nth-child(2){width:33%}
.Y th:nth-child(3){width:20%}
@media print{
@page{margin:12mm}
body{padding:0;font-size:12px}
#find,nav{display:none}
.G,.T{content-visibility:visible}
.R{break-inside:avoid;overflow:visible}
.D{break-inside:auto}
.D svg{break-inside:avoid}
figcaption{break-after:avoid}
.R svg{max-width:100%;max-height:245mm;height:auto}
h2,h3,p.C{break-after:avoid}
tr{break-inside:avoid}
thead{display:table-header-group}
}
)";

inline constexpr std::string_view kPageScript = R"(
(function(){
var doc=document,rungs=doc.getElementsByClassName('R'),rows=null,texts=null,at=-1;
doc.body.classList.add('J');
function rowOf(name){
 if(!rows){rows=new Map();doc.querySelectorAll('tbody th').forEach(function(th){
  if(!rows.has(th.textContent))rows.set(th.textContent,th.parentNode.id);});}
 return rows.get(name)||rows.get(name.replace(/^[@%!]+/,''))||rows.get(name.replace(/^[@%!]+/,'').split(/[.,:]/)[0]);
}
doc.addEventListener('click',function(e){
 var t=e.target;
 if(t.tagName!=='text'||!t.closest('.n'))return;
 var id=rowOf(t.textContent);
 if(id)location.hash=id;
});
var bar=doc.createElement('form'),input=doc.createElement('input'),note=doc.createElement('span');
bar.id='find';bar.setAttribute('role','search');
input.type='search';input.placeholder='Rung number, name, address or text';
input.setAttribute('aria-label',input.placeholder);note.setAttribute('aria-live','polite');
function button(text,step){var b=doc.createElement('button');b.type='button';b.textContent=text;
 b.onclick=function(){find(step);};return b;}
bar.append(input,button('Next',1),button('Previous',-1),note);
doc.querySelector('h1').after(bar);
input.oninput=function(){at=-1;note.textContent='';};
bar.onsubmit=function(e){e.preventDefault();find(1);};
function find(step){
 var what=input.value.trim().toLowerCase();
 if(!what)return;
 if(/^\d+$/.test(what)&&doc.getElementById('r'+what)){at=what-1;show('');return;}
 if(!texts){texts=[];for(var i=0;i<rungs.length;i++)texts.push(rungs[i].textContent.toLowerCase());}
 var n=texts.length,i=at<0&&step<0?0:at;
 for(var k=0;k<n;k++){
  i=(i+step+n)%n;
  if(texts[i].includes(what)){at=i;show('rung '+(i+1));return;}
 }
 note.textContent='not found';
}
function show(text){note.textContent=text;history.replaceState(null,'','#r'+(at+1));location.replace('#r'+(at+1));}
})();
)";

} // namespace rung::view
