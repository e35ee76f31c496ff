// What every page has: its style and its script. The page is complete without the script, which adds the search.
#pragma once
#include <string_view>

namespace rung::view {

inline constexpr std::string_view kPageStyle = R"(
body{margin:0;padding:0 24px 48px;background:var(--paper);color:var(--ink);font:15px/1.45 Arial,Helvetica,"DejaVu Sans",sans-serif}
h1{font-size:26px;margin:24px 0 4px;overflow-wrap:anywhere}
h2{font-size:22px;margin:40px 0 8px;border-bottom:2px solid var(--ink)}
h3{font-size:17px;margin:32px 0 8px}
a{color:var(--link);text-decoration:none}
a:hover{text-decoration:underline}
a:focus-visible,text a:focus{outline:2px solid var(--link)}
.tb span{display:inline-block;margin-right:24px}
nav ul{margin:4px 0;padding:0;columns:24em;column-gap:40px;list-style:none}
nav li{display:flex;gap:10px;break-inside:avoid;padding:1px 0;overflow-wrap:anywhere}
nav li span{color:var(--note);min-width:0}
nav li:has(span)>a{flex:none}
nav li i{margin-left:auto;font-style:normal;color:var(--soft);white-space:nowrap}
nav .c0{font-weight:bold}
nav .c0 span,nav .c0 i{font-weight:normal}
nav .c1{padding-left:18px}
nav .c2{padding-left:36px}
p.C{white-space:pre-line;margin:12px 0 4px}
.f{font-size:12px;font-style:normal;color:var(--soft)}
a.f{color:var(--link)}
h2 .f,h3 .f{font-weight:normal;margin-left:8px}
td .g,td.g{color:var(--warn);font-style:normal}
.R{margin:0;padding:14px 0 0;overflow-x:auto}
.R:target{background:var(--found)}
figcaption{margin-bottom:4px;display:flex;flex-wrap:wrap;gap:2px 12px;align-items:baseline;font-size:15px}
figcaption b{min-width:28px}
figcaption span{font-weight:bold;flex:1 1 12em}
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
#find{position:sticky;top:0;z-index:1;background:var(--paper);padding:8px 0;border-bottom:1px solid var(--line);display:flex;flex-wrap:wrap;align-items:center;gap:8px}
#find input{font:inherit;flex:0 1 22em;min-width:0;padding:3px 6px}
#find button{font:inherit;padding:2px 12px}
.R,h2,h3,tr{scroll-margin-top:56px}
text.hit{paint-order:stroke;stroke:var(--hit);stroke-width:5px;stroke-linejoin:round}
text.now{stroke:var(--now);stroke-width:8px}
.hit:not(text){background:var(--hit)}
.now:not(text){background:var(--now);outline:2px solid var(--ink)}
.H0,.H1,.H2,.H3,.H4,.H5,.N{border-left:8px solid var(--line);padding-left:10px;print-color-adjust:exact}
.H1{border-left-color:var(--heat1)}
.H2{border-left-color:var(--heat2)}
.H3{border-left-color:var(--heat3)}
.H4{border-left-color:var(--heat4)}
.H5{border-left-color:var(--heat5)}
.N{border-left:8px double var(--warn)}
.N .o{color:var(--warn)}
.o{font-style:normal;font-size:13px;white-space:nowrap}
.o s{display:inline-block;height:9px;margin-right:6px;border:1px solid var(--ink);print-color-adjust:exact}
.o .s1{background:var(--heat1)}
.o .s2{background:var(--heat2)}
.o .s3{background:var(--heat3)}
.o .s4{background:var(--heat4)}
.o .s5{background:var(--heat5)}
.lg span{margin-right:24px;white-space:nowrap}
.sw{display:inline-block;box-sizing:border-box;width:22px;height:14px;padding:0;vertical-align:-2px}
.sw.qa{border:1px solid var(--good)}
.sw.qp{border:2px dashed var(--part)}
.sw.qn{border:2px dotted var(--warn)}
.sw.H1,.sw.H2,.sw.H3,.sw.H4,.sw.H5{border-left-width:22px}
.most span{font-weight:bold;margin:0 12px}
.Y th:nth-child(1){width:6%}
.Y th:nth-child(2){width:54%}
.Y th:nth-child(3){width:18%}
.Y th:nth-child(4){width:22%}
.L th:nth-child(2){width:94%}
.Y pre{margin:4px 0 0;font:13px/1.4 "DejaVu Sans Mono",Consolas,Menlo,monospace;white-space:pre-wrap;overflow-wrap:anywhere}
.Y pre i{display:inline-block;width:4em;margin-right:1em;text-align:right;font-style:normal;color:var(--soft);user-select:none}
.Y .b pre{color:var(--note)}
.Y .o{white-space:normal}
@media screen and (max-width:700px){
body{padding:0 12px 32px}
h1{font-size:22px}
nav ul{columns:auto}
.T,.Y{overflow-x:auto}
.T table{min-width:640px}
#find input{flex:1 1 9em}
}
@media print{
body{padding:0;font-size:12px}
h1{margin-top:0}
#find{display:none}
nav{break-after:page}
nav ul{columns:2}
a{color:inherit}
.G,.T{content-visibility:visible}
.R{break-inside:avoid;overflow:visible}
.D{break-inside:auto}
.D svg{break-inside:avoid}
figcaption{break-after:avoid;max-width:none!important}
.R svg{max-width:100%;max-height:240mm;height:auto}
h2,h3,p.C{break-after:avoid}
h2{margin-top:16px}
tr{break-inside:avoid}
thead{display:table-header-group}
}
)";

inline constexpr std::string_view kPageScript = R"(
(function(){
var doc=document,all=null,hits=[],at=-1,wait=0;
var bar=doc.createElement('form'),input=doc.createElement('input'),note=doc.createElement('output');
bar.id='find';bar.setAttribute('role','search');
input.type='search';input.placeholder='Rung number, name, address or text';
input.setAttribute('aria-label',input.placeholder);input.setAttribute('aria-keyshortcuts','/');
note.setAttribute('aria-live','polite');
function button(text,step,title){var b=doc.createElement('button');b.type='button';b.textContent=text;
 b.title=title;b.onclick=function(){search();go(step);};return b;}
bar.append(input,button('Next',1,'Enter'),button('Previous',-1,'Shift and Enter'),note);
doc.querySelector('h1').after(bar);
// An address with and without leading zeros, X002.1 and X2.1, is the same.
function plain(text){return text.toLowerCase().replace(/\b([a-z])0+(?=\d)/g,'$1');}
function texts(){
 if(!all)all=Array.from(doc.querySelectorAll(
  'figcaption span,figcaption .f,figcaption .o,.R p,main text,main p.C,main h2,main h3,main td,main tbody th'),
  function(e){return[e,plain(e.textContent)];});
 return all;
}
function search(){
 var what=input.value.trim().toLowerCase();
 clearTimeout(wait);
 if(what===search.what)return;
 search.what=what;
 hits.forEach(function(e){e.classList.remove('hit','now');});
 hits=what?texts().filter(function(t){return t[1].includes(plain(what));}).map(function(t){return t[0];}):[];
 var rung=/^\d+$/.test(what)&&doc.getElementById('r'+what);
 if(rung)hits.unshift(rung.querySelector('figcaption b,th'));
 hits.forEach(function(e){e.classList.add('hit');});
 at=-1;report();
}
function report(){note.textContent=!search.what?'':!hits.length?'not found':
 at<0?hits.length+(hits.length>1?' hits':' hit'):(at+1)+' of '+hits.length;}
function go(step){
 if(!hits.length)return;
 if(at>=0)hits[at].classList.remove('now');
 at=at<0&&step<0?hits.length-1:(at+step+hits.length)%hits.length;
 var e=hits[at],home=e.closest('figure,tr[id],h2,h3');
 e.classList.add('now');
 if(home&&home.id)location.replace('#'+home.id);
 e.scrollIntoView({block:'center',inline:'nearest'});
 report();
}
input.oninput=function(){clearTimeout(wait);wait=setTimeout(search,150);};
input.onkeydown=function(e){
 if(e.key==='Enter'){e.preventDefault();search();go(e.shiftKey?-1:1);}
 if(e.key==='Escape'){input.value='';search();input.blur();}
};
bar.onsubmit=function(e){e.preventDefault();};
doc.addEventListener('keydown',function(e){
 if(e.key!=='/'||e.ctrlKey||e.metaKey||e.altKey||e.target===input)return;
 e.preventDefault();input.focus();input.select();
});
})();
)";

} // namespace rung::view
